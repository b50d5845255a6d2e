"""Random requests for all paths of the OpenAPI document of a server, by Schemathesis."""

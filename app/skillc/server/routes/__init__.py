"""The endpoints of the API, one file for each resource; `ENDPOINTS` in `server.endpoints` has them all."""

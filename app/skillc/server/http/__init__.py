"""How the API is spoken: requests, answers, streams, and the document that describes them."""

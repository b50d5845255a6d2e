"""The reference of a library as pages to browse: start at `site`."""

"""The demo scene: a living room of 32 mesh instances and 94074 triangles, built from plain arithmetic."""

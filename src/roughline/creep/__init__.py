"""Bodies that creep: their laws, their memory, and how they are pressed over time."""

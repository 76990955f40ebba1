"""From a question to an assessment: one body, its materials and loads."""

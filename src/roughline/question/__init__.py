"""What is asked: a question, its fields and topographies, before anything is pressed."""

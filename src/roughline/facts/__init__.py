"""What is worth telling of an answer, as values, and the words for each kind of it."""

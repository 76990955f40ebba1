"""From a question to an assessment: its body pressed, answers and their intervals."""

"""The studies: plans, reductions of their results, and the pages that are made of them."""

"""The study: its plan, exponents, claims and page."""

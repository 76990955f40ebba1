"""The lab: a local page to look, touch and ask, over the same functions as the command line."""

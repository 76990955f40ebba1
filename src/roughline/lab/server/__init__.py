"""A server that hands the questions of pages to processes, and their answers to the pages."""

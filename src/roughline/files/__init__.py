"""Topographies in files: instruments, our own NetCDF, archives."""

"""Topographies in files: of instruments, in roughline's own NetCDF, in archives."""

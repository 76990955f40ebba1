"""My surface: a file of an instrument, prepared, pressed and answered for."""

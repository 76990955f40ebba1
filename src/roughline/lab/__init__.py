"""The lab: a local page that offers the functions of the command line, with sliders and figures."""

"""What is inferred from a measured surface: its law, departures, roughness."""

"""What the body is: how it is displaced by pressure, on any grid and in any units."""

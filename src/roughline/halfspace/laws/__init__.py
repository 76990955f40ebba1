"""What pressure and gap obey at a node."""

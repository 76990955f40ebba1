"""The study of friction: micro-slip and loops of rough contacts, and of their reduced lines."""

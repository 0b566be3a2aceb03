"""What people and programs read: text, JSON, the catalogue."""

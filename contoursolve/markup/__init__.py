"""HTML of findings and contours, escaped by htpy, for notebooks and pages alike."""

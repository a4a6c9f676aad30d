"""What plots and pages show, as data."""

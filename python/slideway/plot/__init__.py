"""Plots of results: each takes an axis or makes one, and returns it."""

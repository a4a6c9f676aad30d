"""The package's version, the same as the program's."""

__version__ = "0.3.0"

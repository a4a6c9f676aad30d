"""The pictures of the documentation (scripts/pictures.sh)."""

"""What the findings rest on: experiments, their numbers, and whether these are resolved."""

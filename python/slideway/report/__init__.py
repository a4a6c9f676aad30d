"""One self-contained page about a result, to look at without a network.

>>> from slideway import report
>>> report.write.__name__
'write'
"""

from .page import write

__all__ = ["write"]

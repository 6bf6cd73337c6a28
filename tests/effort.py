"""How many examples a property is tried with: see the profiles in ``conftest.py``."""

from hypothesis import settings

costly = settings(max_examples=settings.default.max_examples // 2)
"""For properties whose examples take a tenth of a second or more each."""

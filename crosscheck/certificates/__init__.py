"""Verifies certificates of `replan audit` with integers and fractions alone.

A certificate says that no data could have printed some numbers. Nothing in it is taken on trust but the
printed digits, the reading of their ends, and what is given besides (n, a grain): spans are computed again
from the digits, and every step is computed again or compared.
"""

from certificates.verify import Refused, verify

__all__ = ["Refused", "verify"]

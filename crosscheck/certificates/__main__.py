"""`python -m certificates FILE…`: verifies certificates, one line each; exit code 3 if one is refused."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from certificates import Refused, verify


def main() -> int:
    """Verifies every file named."""
    refused = 0
    for name in sys.argv[1:]:
        try:
            verify(json.loads(Path(name).read_text(encoding="utf-8")))
            print(f"{name}: verified")
        except (Refused, OSError, ValueError) as error:
            refused += 1
            print(f"{name}: refused: {error}")
    return 3 if refused else 0


if __name__ == "__main__":
    sys.exit(main())

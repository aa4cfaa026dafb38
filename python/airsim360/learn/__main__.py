"""python3 -m airsim360.learn: reference programs that learn to see from our worlds. `--help` of each command says more."""
import sys

from .commands import main

if __name__ == "__main__":
    sys.exit(main())

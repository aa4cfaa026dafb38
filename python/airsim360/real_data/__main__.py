"""python3 -m airsim360.real_data"""
import sys

from . import main

sys.exit(main())

"""Reference programs that learn to see from our worlds: labels of outdoor pictures, range, and attitude (docs/guide/learning.md).

    python3 -m airsim360.learn segment train --out seg         # draws its training frames, trains, writes seg/model.pt
    python3 -m airsim360.learn segment apply photo.jpg --model seg --out labels

Needs Debian's python3-torch and python3-opencv; nothing else of airsim360 imports this package.
"""

"""Draws the curves of a crush while it runs: live.py [CASE]"""
import sys

import cellcrush as cc

job = cc.connect().submit(sys.argv[1] if len(sys.argv) > 1 else "preset:type-i")
ax = job.live_plot()
ax.figure.savefig("live.pdf")
print(job.name, job.state)

"""The elastic force of two equal bubbles in Yade, to be run by Yade: elastic.py does. Prints overlap/R,force.

Yade's law has a surface tension of its own, and takes this, not the one of the material.
"""
from yade import *    # noqa: F403  (Yade's way)
import os
import sys

R, SIGMA = float(os.environ["R"]), float(os.environ["SIGMA"])
PLACES = [float(word) for word in os.environ["OVERLAPS"].split()]    # over R

O.materials.append(BubbleMat(density=1000, surfaceTension=SIGMA))    # noqa: F405
first, second = (O.bodies.append(sphere((0, 0, z), R)) for z in (0.0, 1.999 * R))    # noqa: F405
O.engines = [    # noqa: F405
    ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0),    # noqa: F405
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_BubbleMat_BubbleMat_BubblePhys()],    # noqa: F405
                    [Law2_ScGeom_BubblePhys_Bubble(surfaceTension=SIGMA)])]    # noqa: F405
O.dt = 1e-30    # noqa: F405
for x in PLACES:
    O.bodies[second].state.pos = (0, 0, (2.0 - x) * R)    # noqa: F405
    O.step()    # noqa: F405
    print(f"force {x:.6g} {O.interactions[first, second].phys.normalForce.norm():.10g}")    # noqa: F405
sys.exit(0)

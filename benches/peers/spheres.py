# The bench's state of equal spheres in Yade: same radii, stiffness, restitution, friction, gravity, step.
# Environment: STATE (dump file), SCALED, COPIES, GATE (1 with the gate closed), STEPS.
import os
import time
from math import radians, sin, cos

environment = os.environ
size = (float(environment["SCALED"]) / 5406) ** (1 / 3)
width = 0.30 * size * float(environment["COPIES"])
steps = int(environment["STEPS"])


def material(friction, name):
    O.materials.append(
        ViscElMat(young=1e8, poisson=2 / 7, en=0.3, et=1, density=2701, frictionAngle=radians(friction), label=name)
    )


for friction, name in [(53, "grains"), (25, "base"), (15, "sides"), (21, "wall")]:
    material(friction, name)
planes = [(0, 2, 1, "base"), (0, 1, 1, "sides"), (width, 1, -1, "sides"), (0, 0, 1, "sides"), (2.19 * size, 0, -1, "wall")]
if environment["GATE"] == "1":
    planes.append((0.44 * size, 0, -1, "sides"))
for place, axis, sense, name in planes:
    O.bodies.append(wall(place, axis, sense=sense, material=name))
with open(environment["STATE"]) as state:
    for line in state.read().split("ITEM: ATOMS")[1].splitlines()[1:]:
        values = [float(word) for word in line.split()]
        body = O.bodies[O.bodies.append(sphere(Vector3(*values[1:4]), 0.007635, material="grains"))]
        body.state.vel = Vector3(*values[4:7])
        body.state.angVel = Vector3(*values[7:10])
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=-0.2),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
        [Law2_ScGeom_ViscElPhys_Basic()],
    ),
    NewtonIntegrator(damping=0, gravity=(9.81 * sin(radians(40)), 0, -9.81 * cos(radians(40)))),
]
O.dt = 1e-5
O.run(100, True)
start = time.time()
O.run(steps, True)
print("ns %.1f" % ((time.time() - start) / steps / (len(O.bodies) - len(planes)) * 1e9), flush=True)
os._exit(0)

# A bed of balls for YADE. Numbers come from compare.py as JSON in the variable PEER_CASE; it says
# what is alike and what is not.
import json, math, os, time
from yade import geom, utils
from yade import *

case = json.loads(os.environ["PEER_CASE"])
k, dt = case["k"], case["dt"]
# Two bodies with equal numbers share k and c evenly, hence the factors of two; c is for the pair.
material = O.materials.append(ViscElMat(
    kn=2 * k, ks=2 * k, cn=2 * case["c"], cs=2 * case["c"],
    frictionAngle=math.atan(case["friction"]), density=1500))
wall = material
for line in open(case["balls"]):
    x, y, z, radius, density = map(float, line.split())
    n = O.bodies.append(utils.sphere((x, y, z), radius, material=material))
    body = O.bodies[n]
    body.state.mass = 4 / 3 * math.pi * radius**3 * density
    body.state.inertia = Vector3.Ones * 0.4 * body.state.mass * radius**2
x0, x1, y0, y1, z0, z1 = (case[name] for name in ("x0", "x1", "y0", "y1", "z0", "z1"))
if case["shape"] == "cylinder":
    # There is no round wall: a prism of flat patches that touches the cylinder from outside.
    sides = 60
    O.bodies.append(geom.facetCylinder(
        center=(0, 0, 0.5 * (z0 + z1)), radius=x1 / math.cos(math.pi / sides), height=z1 - z0,
        segmentsNumber=sides, wallMask=4, material=wall))
else:
    for axis, low, high in ((0, x0, x1), (1, y0, y1)):
        O.bodies.append(utils.wall(low, axis=axis, sense=0, material=wall))
        O.bodies.append(utils.wall(high, axis=axis, sense=0, material=wall))
O.bodies.append(utils.wall(z0, axis=2, sense=0, material=wall))
O.bodies.append(utils.wall(z1, axis=2, sense=0, material=wall))

newton = NewtonIntegrator(damping=0, gravity=(0, 0, -9.8))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb(), Bo1_Wall_Aabb()],
                          verletDist=0.5 * case["skin"]),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
        [Law2_ScGeom_ViscElPhys_Basic()]),
    newton,
]
if case["gravity"] == "pull":
    pulses = ((0.0035, 0.0075, 1), (0.0425, 0.0465, -1), (0.0535, 0.0575, -1), (0.0925, 0.0965, 1))

    def pull():
        p = O.time - case["period"] * math.floor(O.time / case["period"])
        a = sum(sign * case["push"] for low, high, sign in pulses if low < p < high)
        newton.gravity = (0, 0, -9.8 - a)

    O.engines = [PyRunner(command="pull()", iterPeriod=1)] + O.engines
O.dt = dt
O.run(case["warm"], wait=True)
start = time.time()
O.run(case["steps"], wait=True)
seconds = time.time() - start
balls = [b for b in O.bodies if isinstance(b.shape, Sphere)]
energy = sum(0.5 * b.state.mass * b.state.vel.squaredNorm() for b in balls)
touching = sum(1 for i in O.interactions if i.isReal
               and isinstance(O.bodies[i.id1].shape, Sphere) and isinstance(O.bodies[i.id2].shape, Sphere))
print("LOOP", seconds)
print("RESULT energy", energy, "touching", touching)

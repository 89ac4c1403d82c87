"""The ropes and ring nets of nets.json in Kratos Multiphysics; prints a row of JSON for each scene.

What Kratos solves, as its elements were read and as they were seen to behave in version 10.4:

- a rope that slides through its nodes (SlidingCableElement3D3N) has one Green strain over its whole way l of rest length L,
  e = (l² / L² - 1) / 2, and the tension N = EA e l / L. With friction the first piece keeps N, and behind each ring it is
  2 mu N sin(theta / 2) more where the next piece has grown more than the last, else as much less, theta being the turn at the ring. How much
  a piece has grown is told by its projection on where it first lay; where neither is shorter than at first there is no friction;
- a ring (RingElement3D4N, RingElement3D3N) is such a rope that closes, without friction and without bending: it is taut from the way that its
  nodes have in their reference, and with a shorter way it pushes. Each of its nodes gets the mass of the whole ring, so a fourth is given here;
- a piece of rope (CableElement3D2N) has the same law by itself and does not push;
- a diagonal that bends is made of such a piece of length w with a tension b (w - D) of its own and EA = b D, so that force and slope are
  those of b (d - D) at d = w. EmpiricalSpringElement3D2N would be the element for it, but version 10.4.4 turns its force into space by
  the transposed rotation: along (0, 3, 4) it has none.

The laws of this project have strains of the first order, T = EA (l / L - 1), so that at the same strain s = l / L - 1 Kratos has
(1 + 3/2 s + 1/2 s²) times the tension.

Usage: nets.py nets.json
"""

import json
import sys
import time
from math import dist, hypot, sqrt

import KratosMultiphysics as kratos
import KratosMultiphysics.CableNetApplication as cables
import KratosMultiphysics.StructuralMechanicsApplication as structures

AXES = (kratos.DISPLACEMENT_X, kratos.DISPLACEMENT_Y, kratos.DISPLACEMENT_Z)
REACTIONS = (kratos.REACTION_X, kratos.REACTION_Y, kratos.REACTION_Z)
VARIABLES = (
    kratos.DISPLACEMENT,
    kratos.REACTION,
    structures.POINT_LOAD,
    kratos.VOLUME_ACCELERATION,
    kratos.VELOCITY,
    kratos.ACCELERATION,
    structures.MIDDLE_VELOCITY,
    kratos.NODAL_MASS,
    kratos.FORCE_RESIDUAL,
    kratos.RESIDUAL_VECTOR,
)
# Steps between two readings of all tensions and reactions of a net that is hit.
READ_EVERY = 10


class Net:
    """A part of Kratos' model, with what is read off it."""

    def __init__(self):
        self.model = kratos.Model()
        self.part = self.model.CreateModelPart("net")
        self.part.ProcessInfo[kratos.DOMAIN_SIZE] = 3
        for variable in VARIABLES:
            self.part.AddNodalSolutionStepVariable(variable)
        self.part.SetBufferSize(3)
        self.start = {}
        self.anchors = []
        self.pulling = []

    def node(self, reference, free, place=None):
        """Adds a node that may move along the axes `free`; it starts at `place` (m)."""
        node = self.part.CreateNewNode(len(self.part.Nodes) + 1, *reference)
        place = place or reference
        self.start[node.Id] = list(place)
        for axis, (moves, reacts) in enumerate(zip(AXES, REACTIONS)):
            node.AddDof(moves, reacts)
            node.SetSolutionStepValue(moves, place[axis] - reference[axis])
            if axis not in free:
                node.Fix(moves)
        if not free:
            self.anchors.append(node.Id)
        return node.Id

    def shift(self, node, axis, by):
        """Moves where the search for rest begins (m)."""
        now = self.part.Nodes[node].GetSolutionStepValue(AXES[axis])
        self.part.Nodes[node].SetSolutionStepValue(AXES[axis], now + by)

    def load(self, node, force):
        """Puts a force (N) on a node."""
        self.part.CreateNewCondition("PointLoadCondition3D1N", len(self.part.Conditions) + 1, [node], self.part.GetProperties()[0])
        self.part.Nodes[node].SetSolutionStepValue(structures.POINT_LOAD, 0, kratos.Array3(force))

    def material(self, axial, line_mass, pull=0.0):
        """Of a stiffness EA (N), a mass per length (kg/m), and a tension where its nodes have their reference (N)."""
        material = self.part.CreateNewProperties(len(self.part.Properties) + 1)
        material[kratos.YOUNG_MODULUS] = axial
        material[structures.CROSS_AREA] = 1.0
        material[kratos.DENSITY] = line_mass
        material[kratos.CONSTITUTIVE_LAW] = structures.TrussConstitutiveLaw()
        material[structures.TRUSS_PRESTRESS_PK2] = pull
        return material

    def element(self, kind, nodes, material):
        return self.part.CreateNewElement(kind, len(self.part.Elements) + 1, nodes, material)

    def sliding_rope(self, nodes, material):
        """Kratos makes a sliding rope of more than three nodes through a process of its own."""
        rope = self.part.CreateSubModelPart("rope")
        rope.AddNodes(nodes)
        rope.AddProperties(material)
        settings = {
            "edge_sub_model_part_name": "net.rope",
            "element_type": "cable",
            "node_id_order": nodes,
            "element_id": len(self.part.Elements) + 1,
            "property_id": material.Id,
        }
        cables.EdgeCableElementProcess(rope, kratos.Parameters(json.dumps(settings))).ExecuteInitialize()
        return self.part.Elements[settings["element_id"]]

    def place(self, node):
        found = self.part.Nodes[node]
        moved = found.GetSolutionStepValue(kratos.DISPLACEMENT)
        return [found.X0 + moved[0], found.Y0 + moved[1], found.Z0 + moved[2]]

    def reaction(self, node):
        return list(self.part.Nodes[node].GetSolutionStepValue(kratos.REACTION))

    def tensions(self):
        """Of every piece of rope and every ring (N), from the forces that the elements themselves put on their nodes."""
        forces = kratos.Vector()
        for kind, element in self.pulling:
            if kind == "piece":
                yield element.CalculateOnIntegrationPoints(kratos.FORCE, self.part.ProcessInfo)[0][0]
                continue
            element.CalculateRightHandSide(forces, self.part.ProcessInfo)
            nodes = [node.Id for node in element.GetNodes()]
            if kind == "rope":
                total = [0.0, 0.0, 0.0]
                for number in range(len(nodes) - 1):
                    total = [sum_ + forces[3 * number + axis] for axis, sum_ in enumerate(total)]
                    yield hypot(*total)
            else:
                yield self.ring_tension(nodes, forces)

    def ring_tension(self, nodes, forces):
        """A contact is drawn by T towards the next and by T towards the last one; positive where that is what the ring does (N)."""
        here, following, last = (self.place(nodes[number]) for number in (0, 1, -1))
        ways = [(b - a) / dist(here, following) + (c - a) / dist(here, last) for a, b, c in zip(here, following, last)]
        return sum(way * force for way, force in zip(ways, forces)) / hypot(*ways) ** 2


def build_sliding(scene):
    net = Net()
    points, guide = scene["points"], scene["guide"]
    last = len(points) - 1
    nodes = [net.node(point, [] if number in (0, last) else [guide]) for number, point in enumerate(points)]
    material = net.material(scene["axial"], scene["line_mass"])
    if scene["friction"]:
        material[kratos.FRICTION_COEFFICIENT] = scene["friction"]
    if scene.get("closed"):
        net.pulling = [("ring", net.element(f"RingElement3D{len(nodes)}N", nodes, material))]
    else:
        net.pulling = [("rope", net.sliding_rope(nodes, material))]
    for node, load in zip(nodes[1:], scene["loads"]):
        net.load(node, [load if axis == guide else 0.0 for axis in range(3)])
        net.shift(node, guide, scene["guess"])
    return net, nodes[1:2]


def hang(net, node, scene, at):
    """Load and first guess of a free node; `at` is its place over half the net's side."""
    if scene["load"]:
        net.load(node, [0.0, 0.0, scene["load"]])
    net.shift(node, 2, scene["guess"] * (1 - at[0] ** 2) * (1 - at[1] ** 2))


def build_ropes(scene):
    net, across, side = Net(), scene["across"], scene["side"]
    nodes = {}
    for column in range(across + 1):
        for row in range(across + 1):
            at = [2 * column / across - 1, 2 * row / across - 1]
            held = 1 in map(abs, at)
            nodes[column, row] = net.node([at[0] * across * side / 2, at[1] * across * side / 2, 0], [] if held else [0, 1, 2])
            if not held:
                hang(net, nodes[column, row], scene, at)
    material = net.material(scene["axial"], scene["line_mass"])
    for (column, row), node in nodes.items():
        for other in (nodes.get((column + 1, row)), nodes.get((column, row + 1))):
            if other and not {node, other} <= set(net.anchors):
                net.pulling.append(("piece", net.element("CableElement3D2N", [node, other], material)))
    return net, [nodes[across // 2, across // 2]]


def contacts(across):
    """Of each ring: right, above, left, below, by twice their place in rings."""
    for column in range(across):
        for row in range(across):
            x, y = 2 * column + 1, 2 * row + 1
            yield [(x + 1, y), (x, y + 1), (x - 1, y), (x, y - 1)]


def build_rings(scene):
    net, across = Net(), scene["across"]
    taut, half, right = scene["taut_half"], scene["half"], scene["right"]
    nodes = {}
    for i, j in dict.fromkeys(contact for ring in contacts(across) for contact in ring):
        x, y = i - across, j - across
        held = across in (abs(x), abs(y))
        more = right if i == 2 * across else [0, 0]
        nodes[i, j] = net.node([x * taut, y * taut, 0], [] if held else [0, 1, 2], [x * half + more[0], y * half + more[1], 0])
        if not held:
            hang(net, nodes[i, j], scene, [x / across, y / across])
    way = 4 * sqrt(2) * taut
    material = net.material(scene["stiffness"] * way, scene["ring_mass"] / way / 4)
    slope, wide = scene["bending"], 2 * taut
    bends = net.material(slope * scene["diameter"], 1e-9, slope * (wide - scene["diameter"]))
    for ring in contacts(across):
        ring = [nodes[contact] for contact in ring]
        net.pulling.append(("ring", net.element("RingElement3D4N", ring, material)))
        if slope:
            for first, second in ((ring[0], ring[2]), (ring[1], ring[3])):
                net.element("CableElement3D2N", [first, second], bends)
    beside = [(across, across + 1), (across, across - 1), (across + 1, across), (across - 1, across)]
    return net, [nodes[contact] for contact in beside if contact in nodes]


def rest(net):
    """Brings the net to rest by Newton's method; returns whether that converged, and the time (s)."""
    solver = kratos.SkylineLUFactorizationSolver()
    builder = kratos.ResidualBasedBlockBuilderAndSolver(solver)
    criterion = kratos.ResidualCriteria(1e-9, 1e-9)
    scheme = kratos.ResidualBasedIncrementalUpdateStaticScheme()
    began = time.perf_counter()
    net.part.CloneTimeStep(1.0)
    strategy = kratos.ResidualBasedNewtonRaphsonStrategy(net.part, scheme, criterion, builder, 300, True, False, True)
    for quiet in (criterion, strategy):
        quiet.SetEchoLevel(0)
    strategy.Initialize()
    strategy.InitializeSolutionStep()
    strategy.Predict()
    converged = strategy.SolveSolutionStep()
    strategy.FinalizeSolutionStep()
    return converged, time.perf_counter() - began


def at_rest(net, _middle, _scene):
    converged, spent = rest(net)
    if not converged:
        return {}, spent
    moved = max(dist(net.place(node), start) for node, start in net.start.items() if node not in net.anchors)
    reactions = [hypot(*net.reaction(node)) for node in net.anchors]
    tensions = list(net.tensions())
    return {
        "largest displacement (m)": moved,
        "largest tension (kN)": max(tensions) * 1e-3,
        "least tension (kN)": min(tensions) * 1e-3,
        "largest reaction of an anchor (kN)": max(reactions) * 1e-3,
        "reactions, sum of their sizes (kN)": sum(reactions) * 1e-3,
    }, spent


def throw(net, middle, hit, step):
    """Gives the middle its mass and speed."""
    velocity = kratos.Array3([0.0, 0.0, -float(hit["speed"])])
    for node in middle:
        element = net.element("NodalConcentratedElement3D1N", [node], net.material(1.0, 1.0))
        element.SetValue(kratos.NODAL_MASS, hit["mass"] / len(middle))
        net.part.Nodes[node].SetSolutionStepValue(kratos.VELOCITY, 0, velocity)
    scheme = structures.ExplicitCentralDifferencesScheme(1.0, 0.0, 0.0)
    strategy = structures.MechanicalExplicitStrategy(net.part, scheme, True, False, True)
    strategy.SetEchoLevel(0)
    net.part.ProcessInfo[kratos.DELTA_TIME] = step
    strategy.Initialize()
    return strategy


def struck(net, middle, scene):
    hit, step = scene["hit"], scene["step"]
    strategy = throw(net, middle, hit, step)
    sag, tension, least, reaction, spent = 0.0, 0.0, 1e99, 0.0, 0.0
    for number in range(round(hit["time"] / step)):
        began = time.perf_counter()
        net.part.CloneTimeStep((number + 1) * step)
        net.part.ProcessInfo[kratos.STEP] += 1
        strategy.Solve()
        spent += time.perf_counter() - began
        sag = max(sag, -net.place(middle[0])[2])
        if number % READ_EVERY == 0:
            tensions = list(net.tensions())
            tension, least = max(tension, *tensions), min(least, *tensions)
            reaction = max(reaction, sum(net.reaction(node)[2] for node in net.anchors))
    return {
        "largest displacement (m)": sag,
        "largest tension (kN)": tension * 1e-3,
        "least tension (kN)": least * 1e-3,
        "largest reaction across the net (kN)": reaction * 1e-3,
    }, spent


def main():
    kratos.Logger.GetDefaultOutput().SetSeverity(kratos.Logger.Severity.WARNING)
    build = {"sliding": build_sliding, "ropes": build_ropes, "rings": build_rings}
    with open(sys.argv[1]) as file:
        scenes = json.load(file)["scenes"]
    for scene in scenes:
        net, middle = build[scene["kind"]](scene)
        found, spent = (struck if "hit" in scene else at_rest)(net, middle, scene)
        print(json.dumps({"scene": scene["name"], "time": spent, "found": found}), flush=True)


main()

#!/usr/bin/env python3
"""Files that lie: mutations.py [--runs N] [--seed N] [--workers N] [--keep DIR] MORTISE {meshes,checkpoints}

Writes small files, changes each at random (a number, a line, a byte, an end that is missing; a checkpoint with its
checksums made right again) and runs the program on it. Every run must end within seconds with exit code 0 or 2, a
checkpoint also with 3 (values of which the solver makes nothing), and tell in one message what is wrong. Prints how
often each exit code came and every run that did not end so."""
import argparse
import collections
import concurrent.futures
import json
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

from processor import openblas

SECONDS = 30
GEOMETRY = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
%s
Physical Volume("cube") = {1};
Physical Surface("low") = {5};
Physical Surface("high") = {6};
"""
CELLS = {"tetrahedra": "MeshSize{:} = 0.6;", "hexahedra": "Transfinite Curve{:} = 3;\nTransfinite Surface{:};\n"
         "Transfinite Volume{:};\nRecombine Surface{:};\nMesh.RecombineAll = 1;"}
BODY = """subsection Body {name}
  set Degree = {degree}
  subsection Mesh
    {mesh}
  end
  subsection Material
    set Young modulus = 1
    set Poisson ratio = 0.3
  end
  subsection Boundary {low}
    set Displacement = {held}
  end
  subsection Boundary {high}
    set Traction = 0; 0; -0.01 * t
  end
end
"""
NUMBERS = [0, 1, 2, 3, 7, 8, 100, 127, 255, 256, 65535, 1000003, 2**31 - 1, 2**31, 2**32 - 1, 2**63 - 1, 2**64 - 1]
REALS = [0., -0., 1., -1., 1e-300, 1e300, float("inf"), float("-inf"), float("nan"), 1e16, 0.5]
environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", DEAL_II_NUM_THREADS="1", **openblas())


def other_number(text, chance):
    """Another number in place of the one in text."""
    if chance.random() < 0.3:
        return chance.choice(["-1", "", "x", "1e999", "-0", "nan", "99999999999999999999", *map(str, NUMBERS)])
    if re.fullmatch(r"-?\d+", text):
        return str(int(text) + chance.choice([-2, -1, 1, 2, 10, -10, 1000]))
    return str(chance.choice(REALS))


def changed_text(content, chance):
    lines = content.decode("latin-1").split("\n")
    # the start of a section is as likely as all that follows
    heads = [i + k for i, line in enumerate(lines) if line.startswith("$") for k in (0, 1, 2) if i + k < len(lines)]
    for _ in range(chance.choice([1, 1, 1, 2, 5])):
        at = chance.choice(heads) if chance.random() < 0.5 else chance.randrange(len(lines))
        at = min(at, len(lines) - 1)
        way = chance.random()
        if way < 0.6:
            numbers = list(re.finditer(r"-?\d[\d.e+-]*", lines[at]))
            if numbers:
                number = chance.choice(numbers)
                lines[at] = lines[at][:number.start()] + other_number(number.group(), chance) + lines[at][number.end():]
        elif way < 0.75 and len(lines) > 1:
            del lines[at]
        elif way < 0.9:
            lines.insert(at, lines[at])
        elif way < 0.95:
            other = chance.randrange(len(lines))
            lines[at], lines[other] = lines[other], lines[at]
        else:
            lines = lines[:at + 1]
            lines[-1] = lines[-1][:chance.randint(0, len(lines[-1]))]
    return "\n".join(lines).encode("latin-1")


def changed_bytes(content, chance, start=0):
    content = bytearray(content)
    for _ in range(chance.choice([1, 1, 1, 2, 5])):
        if len(content) <= start:
            break
        at = chance.randrange(start, len(content))
        at -= (at - start) % chance.choice([1, 4, 8])
        way = chance.random()
        if way < 0.3:
            content[at] = chance.randrange(256)
        elif way < 0.55:
            content[at:at + 4] = struct.pack("<I", chance.choice(NUMBERS) % 2**32)
        elif way < 0.75:
            content[at:at + 8] = struct.pack("<Q", chance.choice(NUMBERS))
        elif way < 0.85:
            content[at:at + 8] = struct.pack("<d", chance.choice(REALS))
        elif way < 0.9:
            del content[at:at + chance.choice([1, 4, 8, 24])]
        elif way < 0.95:
            content[at:at] = content[at:at + chance.choice([1, 4, 8, 24])]
        else:
            del content[at:]
    return bytes(content)


def write_meshes(directory):
    """Names of whole files of every format."""
    names = []
    for cells, commands in CELLS.items():
        with open(os.path.join(directory, cells + ".geo"), "w") as file:
            file.write(GEOMETRY % commands)
        for order in (1, 2):
            for version in ("msh22", "msh41"):
                for binary in (False, True):
                    names.append(f"{cells}{order}{version}{'b' if binary else ''}.msh")
                    subprocess.run(["gmsh", "-3", "-order", str(order), "-format", version, *(["-bin"] if binary else []),
                                    cells + ".geo", "-o", names[-1]], cwd=directory, check=True, stdout=subprocess.DEVNULL)
    return names


def mesh_case(directory, name, chance):
    with open(os.path.join(directory, name), "rb") as file:
        content = file.read()
    changed = changed_bytes(content, chance) if name.endswith("b.msh") and chance.random() < 0.8 else changed_text(content, chance)
    return changed, "mesh.msh", ["scene.prm"], (0, 2)


# Checkpoints of one rank: the header with version, names and sizes of sections, then these

START = 40  # bytes of magic, checksum, format and size of the header


def text_at(header, at):
    length = struct.unpack_from("<Q", header, at)[0]
    return header[at + 8:at + 8 + length], at + 8 + length


def parts_of(content):
    """Magic and format, version, sections in their order."""
    at = START + struct.unpack_from("<Q", content, 32)[0]
    header = content[START:at]
    version, here = text_at(header, 0)
    names, n = [], struct.unpack_from("<Q", header, here)[0]
    here += 8
    for _ in range(n):
        name, here = text_at(header, here)
        names.append(name)
    sizes = {}
    here += 16  # one rank, and its number of sections
    for _ in range(n):
        name, here = text_at(header, here)
        sizes[name] = struct.unpack_from("<Q", header, here)[0]
        here += 16
    sections = {}
    for name in names:
        sections[name.decode()] = content[at:at + sizes[name]]
        at += sizes[name]
    return content[:16], struct.unpack_from("<Q", content, 24)[0], version, sections


def with_checksums(magic, form, version, sections):
    def text(name):
        return struct.pack("<Q", len(name)) + name.encode()
    header = struct.pack("<Q", len(version)) + version + struct.pack("<Q", len(sections)) + b"".join(text(name) for name in sections)
    header += struct.pack("<QQ", 1, len(sections))
    header += b"".join(text(name) + struct.pack("<QQ", len(part), zlib.crc32(part)) for name, part in sorted(sections.items()))
    checked = struct.pack("<QQ", form, len(header)) + header
    return magic + struct.pack("<Q", zlib.crc32(checked)) + checked + b"".join(sections.values())


def leaves(tree, path=()):
    yield path
    children = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, child in children:
        yield from leaves(child, path + (key,))


def changed_json(text, chance):
    tree = json.loads(text)
    if chance.random() < 0.3 and isinstance(tree, dict):
        tree["steps"] = changed_json(tree["steps"].encode(), chance).decode("latin-1")
        return json.dumps(tree).encode()
    path = chance.choice([path for path in leaves(tree) if path])
    parent = tree
    for key in path[:-1]:
        parent = parent[key]
    if chance.random() < 0.2:
        del parent[path[-1]]
    else:
        parent[path[-1]] = chance.choice([None, True, "", "x", [], {}, -1, 0, 1, 7, 2**31, 2**32, 2**64 - 1, 1e300, -1e-300, 0.5,
                                          [[1, 2]], {"a": 1}])
    return json.dumps(tree).encode()


def checkpoint_case(directory, name, chance):
    with open(os.path.join(directory, name, "checkpoint.bin"), "rb") as file:
        magic, form, version, sections = parts_of(file.read())
    way, name = chance.random(), chance.choice(sorted(sections))
    if way < 0.3:
        sections["run"] = changed_json(sections["run"], chance)
    elif way < 0.35:
        del sections[name]
    else:
        sections[name] = changed_bytes(sections[name], chance) if sections[name] else b"x"
    return with_checksums(magic, form, version, sections), "checkpoint.bin", ["--restart", "."], (0, 2, 3)


def write_checkpoints(program, directory):
    """Names of directories with checkpoints, and options to go on: ties in steps, contact, cycles of refinement, for a
    quantity, of a geometry."""
    box = "set Source = box\n    set Extent = 0, 0, {0}, 1, 1, {1}\n    set Subdivisions = 2, 2, 1"
    tied = BODY.format(name="low", degree=2, mesh=box.format(0, 1), low="zmin", high="xmin", held="0, 0, 0")
    tied += BODY.format(name="high", degree=1, mesh=box.format(1, 2), low="zmax", high="xmin", held="0, 0, -0.001 * t")
    face = "set Interfaces = face\nset Bodies = low, high\nsubsection Interface face\n  set Slave = low: zmax\n  set Master = high: zmin\n{}end\n"
    steps = "subsection Steps\n  set End time = {}\n  set Step = 1\nend\n"
    output = "subsection Output\n  set Checkpoint every = 1\n  set Fields =\nend\n"
    cycles = "subsection Adaptivity\n  set Target error = 0.05\n  set Largest number of unknowns = 4000\nend\n"
    wedge = "set Source = file\n    set File = " + os.path.join(directory, "wedge.geo")
    with open(os.path.join(directory, "wedge.geo"), "w") as file:
        file.write(GEOMETRY % CELLS["tetrahedra"])
    one = "set Bodies = low\n" + BODY.format(name="low", degree=1, mesh=wedge, low="low", high="high", held="0, 0, 0").replace("* t", "")
    scenes = {"tie": face.format("") + tied + steps.format(2) + output,
              "contact": face.format("  set Law = contact\n") + tied + steps.format(2) + output,
              "cycles": face.format("") + tied.replace("* t", "") + cycles + output,
              "quantity": face.format("") + tied.replace("* t", "") + cycles.replace("  set Target", "  set Quantity = tip, z\n  set Target") +
                          output.replace("  set Fields", "  set Points = tip: high: 0.5, 0.5, 2\n  set Fields"),
              "meshes": one + cycles + output}
    for name, scene in scenes.items():
        with open(os.path.join(directory, name + ".prm"), "w") as file:
            file.write(scene)
        result = subprocess.run([program, name + ".prm", "--output", name], cwd=directory, env=environment, capture_output=True, text=True)
        if not os.path.exists(os.path.join(directory, name, "checkpoint.bin")):
            sys.exit(f"{name}: no checkpoint\n{result.stdout}{result.stderr}")
    options = {name: ["--set", "Steps/End time=3"] if name in ("tie", "contact") else ["--set", "Adaptivity/Target error=0.04"] for name in scenes}
    return list(scenes), options


def run(program, directory, changed, file_name, arguments, allowed, scene):
    with tempfile.TemporaryDirectory(dir=directory) as here:
        with open(os.path.join(here, file_name), "wb") as file:
            file.write(changed)
        if scene:
            with open(os.path.join(here, "scene.prm"), "w") as file:
                file.write(scene)
        try:
            result = subprocess.run(["bash", "-c", 'ulimit -v 6000000; exec "$@"', "bash", program, *arguments], cwd=here, env=environment,
                                    capture_output=True, timeout=SECONDS)
        except subprocess.TimeoutExpired:
            return "hangs", False, ""
        errors = result.stderr.decode("latin-1").strip()
        good = result.returncode in allowed and (result.returncode == 0 or
                                                 (len(re.findall("^error: |^not converged: ", errors, re.M)) == 1 and len(errors) < 4000))
        return result.returncode, good, errors


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("kind", choices=["meshes", "checkpoints"])
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--keep", help="directory for the files of runs that did not end well")
    given = parser.parse_args()
    program = os.path.abspath(given.program)
    codes, bad, messages = collections.Counter(), 0, collections.Counter()
    with tempfile.TemporaryDirectory() as directory:
        options = {}
        scene = None
        if given.kind == "meshes":
            names = write_meshes(directory)
            scene = "set Bodies = cube\n" + BODY.format(name="cube", degree=1, mesh="set Source = file\n    set File = mesh.msh", low="low",
                                                       high="high", held="0, 0, 0").replace("* t", "") + "subsection Output\n  set Fields =\nend\n"
        else:
            names, options = write_checkpoints(program, directory)
        make = mesh_case if given.kind == "meshes" else checkpoint_case

        def one(number):
            chance = random.Random(given.seed * 1000003 + number)
            name = names[number % len(names)]
            changed, file_name, arguments, allowed = make(directory, name, chance)
            return number, name, changed, file_name, run(program, directory, changed, file_name, arguments + options.get(name, []), allowed, scene)

        with concurrent.futures.ThreadPoolExecutor(given.workers) as pool:
            for number, name, changed, file_name, (code, good, errors) in pool.map(one, range(given.runs)):
                codes[code] += 1
                messages[re.sub(r"-?\d[\d.e+-]*", "N", errors)[:160]] += 1
                if good:
                    continue
                bad += 1
                print(f"run {number} of {name}: {code}: {errors[:300]}", flush=True)
                if given.keep:
                    os.makedirs(given.keep, exist_ok=True)
                    with open(os.path.join(given.keep, f"{number}.{name}.{file_name}"), "wb") as file:
                        file.write(changed)
                    if scene:
                        with open(os.path.join(given.keep, "scene.prm"), "w") as file:
                            file.write(scene)
    for message, n in messages.most_common(40):
        print(f"  {n:5d}  {message}")
    print(f"{given.runs} {given.kind}: " + ", ".join(f"{n} of {code}" for code, n in sorted(codes.items(), key=str)) + f"; {bad} did not end as they should")


if __name__ == "__main__":
    main()

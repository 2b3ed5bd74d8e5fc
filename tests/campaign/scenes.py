"""Parameter files that are damaged or changed at random: what stands in them, and in them alone."""
import glob
import os
import re

SET = re.compile(r"^(\s*set\s+)([^=#]+?)(\s*=\s*)([^#]*?)\s*$")
NUMBER = re.compile(r"-?\d+\.?\d*(?:[eE][-+]?\d+)?")
NUMBERS = ["0", "-0", "-1", "1", "2", "3", "0.5", "0.3", "1e-300", "1e300", "-1e300", "1e-30", "1e30", "nan", "inf", "-inf", "1e999",
           "2147483647", "2147483648", "4294967295", "4294967296", "-2147483649", "18446744073709551616", "1e-12", "1e12",
           "0x10", "1e", "--1", "+", "1.5", "1,5", "''", "%s", "\xbd", "1 2"]
EXPRESSIONS = ["x", "t", "exact", "auto", "-", "1/0", "0/0", "log(-x)", "sqrt(x-1)", "x^1000", "exp(1000*x)", "1e308*x*x",
               "if(x>0,1,0)", "if(x,", "sin(", ")", "pi", "x*y*z*t", "(((1)))", "1/(x-0.5)", "max(x)", "pow(0,0)", "tan(pi/2)",
               "2^-t", "atan2(0,0)", "1;2", "; ;", "normal: 0", "normal: t", "rand()", "x y", "1e-320", "t^t", "-x", "if(t>0.5,1/0,1)"]
LARGEST = 600  # cells of a scene that is drawn
MESH_SIZES = {"Subdivisions", "Refinements", "Refine near", "Degree", "Degree near", "Degree by region", "Mesh size"}


class Scene:
    def __init__(self, file):
        self.file = file
        directory = os.path.dirname(os.path.abspath(file))
        with open(file, encoding="latin-1") as opened:
            self.lines = [absolute(line.rstrip("\n"), directory) for line in opened]
        self.lines = [line for line in self.lines if line.strip() and not line.startswith("#")]


def absolute(line, directory):
    """The mesh is looked for beside the parameter file."""
    found = SET.match(line)
    if found and found.group(2) == "File":
        beside = os.path.join(directory, found.group(4))
        if os.path.exists(beside):
            return found.group(1) + "File = " + os.path.abspath(beside)
    return line


class Corpus:
    """Scenes, the values that their parameters have, and what is allowed for each parameter."""

    def __init__(self, directories, reference):
        files = sorted(f for d in directories for f in glob.glob(os.path.join(d, "*.prm")))
        self.scenes = [Scene(f) for f in files]
        self.by_name = {os.path.basename(s.file)[:-4]: s for s in self.scenes}
        self.values, self.lines = {}, []
        for scene in self.scenes:
            for line in scene.lines:
                found = SET.match(line)
                if found:
                    self.values.setdefault(found.group(2), set()).add(found.group(4))
                    self.lines.append(line)
        self.sections = {}  # parameters by the first word of their section, and choices of parameters
        section, comment = [""], ""
        for line in reference.splitlines():
            word = line.strip()
            if word.startswith("#"):
                comment += " " + word[1:].strip()
            elif word.startswith("subsection"):
                section.append(word.split()[1])
            elif word == "end":
                section.pop()
            found = SET.match(line)
            if found or word.startswith("set"):
                name = word[3:].split("=")[0].strip()
                self.sections.setdefault(section[-1], []).append(name)
                one_of = re.search(r"Allowed: one of: (.*?)\.\s*$", comment)
                if one_of:
                    self.values.setdefault(name, set()).update(one_of.group(1).split(", "))
            if not word.startswith("#"):
                comment = ""
        self.values = {name: sorted(values) for name, values in sorted(self.values.items())}


def draw(random, corpus, scenes):
    """A scene and the operations that change it, each a name with the seed of what it draws."""
    scene = random.choice(scenes)
    n = random.choice([1, 1, 1, 2, 2, 3, 4, 6])
    return scene, [(random.choices(list(OPERATIONS), [w for _, w in OPERATIONS.values()])[0], random.getrandbits(32))
                   for _ in range(n)]


def apply(random_of, corpus, scene, operations):
    lines = list(scene.lines)
    for name, seed in operations:
        before = list(lines)
        OPERATIONS[name][0](random_of(seed), lines, corpus)
        if size(lines) > max(LARGEST, size(before)) and seed % 64:
            lines = before
    return "\n".join(lines) + "\n"


def size(lines):
    """Cells times the cube of the degree, roughly: what is large takes long, and is no finding."""
    total, cells = 0, 1
    degree = 1.
    for line in lines:
        found = SET.match(line)
        if found and found.group(2) in ("Subdivisions", "Refinements", "Degree"):
            numbers = [float(n) for n in NUMBER.findall(found.group(4))] or [1.]
            if found.group(2) == "Subdivisions":
                cells = 1
                for n in numbers:
                    cells *= max(1., min(abs(n), 1e9))
                total += cells
            elif found.group(2) == "Refinements":
                total += cells * 8. ** min(abs(numbers[0]), 30.)
            else:
                degree = max(degree, min(abs(numbers[0]), 9.))
        if found and found.group(2) == "Mesh size" and any(0. < abs(float(n)) < 0.05 for n in NUMBER.findall(found.group(4))):
            total += 2 * LARGEST
        if found and found.group(2) in ("Degree near", "Degree by region", "Refine near"):
            for n in NUMBER.findall(found.group(4)):
                if abs(float(n)) > 3:
                    total += 1.
    return total * (degree / 2.) ** 2


def pick(random, lines):
    places = [i for i, line in enumerate(lines) if SET.match(line)]
    return random.choice(places) if places else None


def put(lines, i, value):
    found = SET.match(lines[i])
    lines[i] = found.group(1) + found.group(2) + " = " + value


def number(random, lines, _):
    i = pick(random, lines)
    if i is None:
        return
    value = SET.match(lines[i]).group(4)
    found = list(NUMBER.finditer(value))
    new = random.choice(NUMBERS)
    if not found:
        return put(lines, i, new)
    at = random.choice(found)
    if random.random() < 0.5:
        old = float(at.group()) if len(at.group()) < 30 else 1.
        new = "%.6g" % (old * random.choice([-1., 0.1, 0.5, 0.999999, 1.0001, 1.1, 2., 10., 1e3, 1e-6, 1e6]))
        if "." not in at.group() and SET.match(lines[i]).group(2) in MESH_SIZES:
            new = str(int(min(abs(old), 1e6)) + random.choice([-1, 1, 1, 2]))
    put(lines, i, value[:at.start()] + new + value[at.end():])


def value_of_another(random, lines, corpus):
    """A value that the same parameter has elsewhere, or that it may have."""
    i = pick(random, lines)
    if i is not None:
        put(lines, i, random.choice(corpus.values.get(SET.match(lines[i]).group(2), ["1"])))


def value_of_any(random, lines, corpus):
    i = pick(random, lines)
    if i is not None:
        put(lines, i, random.choice(corpus.values[random.choice(list(corpus.values))]))


def expression(random, lines, _):
    i = pick(random, lines)
    if i is not None:
        value = SET.match(lines[i]).group(4)
        parts = re.split(r"([;,])", value)
        parts[2 * random.randrange((len(parts) + 1) // 2)] = " " + random.choice(EXPRESSIONS)
        put(lines, i, "".join(parts))


def part(random, lines, _):
    """A part of a list goes, comes twice, or changes its place."""
    i = pick(random, lines)
    if i is not None:
        parts = re.split(r"([;,:])", SET.match(lines[i]).group(4))
        k = random.randrange(len(parts))
        how = random.randrange(3)
        if how == 0:
            del parts[k]
        elif how == 1:
            parts.insert(k, parts[k])
        else:
            m = random.randrange(len(parts))
            parts[k], parts[m] = parts[m], parts[k]
        put(lines, i, "".join(parts))


def added(random, lines, corpus):
    """A parameter that the section does not have yet."""
    places = [i for i, line in enumerate(lines) if line.strip().startswith("subsection")]
    if random.random() < 0.3 or not places:
        section = random.choice(["Solver", "Adaptivity", "Steps", "Output", "Exact solution"])
        lines += ["subsection " + section, "end"]
        places = [len(lines) - 2]
    at = random.choice(places)
    names = corpus.sections.get(lines[at].split()[1] if len(lines[at].split()) > 1 else "", [])
    if names:
        name = random.choice(names)
        value = random.choice(corpus.values.get(name, []) + [random.choice(NUMBERS), random.choice(EXPRESSIONS)])
        lines.insert(at + 1, "set " + name + " = " + value)


def line(random, lines, corpus):
    """A line goes, comes twice, comes from elsewhere, or changes its place."""
    if not lines:
        return
    i, how = random.randrange(len(lines)), random.randrange(5)
    if how == 0:
        del lines[i]
    elif how == 1:
        lines.insert(random.randrange(len(lines)), lines[i])
    elif how == 2:
        lines.insert(random.randrange(len(lines)), lines.pop(i))
    elif how == 3:
        lines.insert(i, random.choice(corpus.lines))
    else:
        del lines[i:i + random.randrange(1, 12)]


def names(random, lines, _):
    """Bodies, boundaries and interfaces are mixed up."""
    known = sorted({word for line in lines for word in re.findall(r"subsection (?:Body|Boundary|Interface) (\S+)", line)} |
                   {"zmin", "zmax", "xmin", "all", "", "a b", "x" * 300, "\xe9", "../up", "Body"})
    places = [i for i, line in enumerate(lines) if re.search(r"subsection|Slave|Master|Bodies|Interfaces|Points|Resultants|Curved", line)]
    if places:
        i = random.choice(places)
        words = re.findall(r"\w+", lines[i])[1:]
        if words:
            old = random.choice(words)
            lines[i] = lines[i].replace(old, random.choice(known))


def damage(random, lines, _):
    """Bytes that are wrong, or a file that ends early."""
    if not lines:
        return
    i = random.randrange(len(lines))
    how = random.randrange(4)
    if how == 0:
        del lines[i:]
    elif how == 1:
        lines[i] = lines[i] * random.choice([2, 50])
    elif lines[i]:
        k = random.randrange(len(lines[i]))
        lines[i] = lines[i][:k] + random.choice(["", "\0", "\xff", "=", "set", ";", " ", "\t", "\\", "\"", "#", "end", chr(random.randrange(1, 256))]) + \
            lines[i][k + random.randrange(2):]


def of_bodies(random, lines, corpus):
    """A whole section is that of another."""
    starts = [i for i, line in enumerate(lines) if line.strip().startswith("subsection")]
    if len(starts) < 2:
        return

    def block(start):
        depth = 0
        for i in range(start, len(lines)):
            word = lines[i].strip()
            depth += word.startswith("subsection") - (word == "end")
            if depth == 0:
                return lines[start:i + 1]
        return lines[start:]
    one, other = random.sample(starts, 2)
    kind = lines[one].split()[1:2]
    alike = [s for s in starts if lines[s].split()[1:2] == kind and s != one]
    if alike and random.random() < 0.8:
        other = random.choice(alike)
    new = block(other)
    lines[one:one + len(block(one))] = [lines[one]] + new[1:]


# with how often they are drawn
OPERATIONS = {"number": (number, 6), "value": (value_of_another, 8), "any value": (value_of_any, 1), "expression": (expression, 3),
              "part": (part, 3), "added": (added, 6), "line": (line, 3), "names": (names, 2), "damage": (damage, 2),
              "section": (of_bodies, 2)}

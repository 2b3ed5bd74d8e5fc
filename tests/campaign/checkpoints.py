"""Checkpoints that are damaged, truncated, exchanged, or changed with checksums that are right."""
import os
import struct
import sys
import zlib

import runner

# scene, settings of the first run, settings with which it goes on
BASES = {
    "linear": ("prm/patch.prm", ["Steps/Step=1", "Steps/End time=2"], ["Steps/End time=3"]),
    "plasticity": ("tests/field/pulled_and_pushed_beyond_yield.prm", ["Steps/End time=2"], ["Steps/End time=2.5"]),
    "arc length": ("tests/field/frame_snaps_through.prm", ["Steps/Number of steps=5"], ["Steps/Number of steps=7"]),
    "mixed": ("tests/field/stretched_both_ways_neo_hooke_isochoric.prm", ["Steps/End time=0.5"], ["Steps/End time=1"]),
    "preload": ("tests/field/bolt_is_stretched_further.prm", ["Steps/End time=1"], ["Steps/End time=2"]),
    "friction": ("tests/field/sheared_to_and_fro_without_slip.prm", ["Steps/End time=2"], ["Steps/End time=3"]),
    "cycles": ("tests/field/balloon_to_a_target.prm", ["Adaptivity/Target error=0.05"], ["Adaptivity/Target error=0.02"]),
    "other linear": ("prm/thick_sphere.prm", ["Steps/Step=1", "Steps/End time=1"], ["Steps/End time=2"])}


class Base:
    def __init__(self, content, settings):
        self.content, self.settings = content, settings
        self.version, self.names, self.ranks = parse(content)
        assert pack(self.version, self.names, self.ranks) == content, "the format of checkpoints is not as expected here"

    def further(self, directory):
        return [w for s in self.settings + ["Output/Directory=" + directory, "Output/Fields="] for w in ("--set", s)]


def bases(campaign, top):
    """The checkpoints that are changed, each with how its run goes on."""
    result = {}
    for name, (scene, first, further) in BASES.items():
        campaign.clean()
        settings = first + ["Output/Checkpoint every=1", "Output/Fields="]
        done = runner.run(campaign.options.mortise, ["--output", campaign.path("results"), os.path.join(top, scene)] +
                          [w for s in settings for w in ("--set", s)], campaign.work, limit=120.)
        file = campaign.path("results/checkpoint.bin")
        if done.code not in (0, 3) or not os.path.exists(file):
            sys.exit("no checkpoint of %s: exit code %s: %s" % (scene, done.code, done.err))
        with open(file, "rb") as opened:
            result[name] = Base(opened.read(), further)
    return result


def parse(content):
    """Version, names of sections, and for each rank the bytes of its sections by name."""
    place = 40

    def integer():
        nonlocal place
        place += 8
        return struct.unpack_from("<Q", content, place - 8)[0]

    def text():
        nonlocal place
        n = integer()
        place += n
        return content[place - n:place]
    version = text()
    names = [text() for _ in range(integer())]
    ranks = []
    for _ in range(integer()):
        ranks.append({text(): (integer(), integer()) for _ in range(integer())})
    for sections in ranks:
        for name in names:
            if name in sections:
                n = sections[name][0]
                sections[name] = content[place:place + n]
                place += n
    return version, names, ranks


def pack(version, names, ranks):
    def text(t):
        return struct.pack("<Q", len(t)) + t
    header = text(version) + struct.pack("<Q", len(names)) + b"".join(text(n) for n in names)
    header += struct.pack("<Q", len(ranks))
    values = b""
    for sections in ranks:
        header += struct.pack("<Q", len(sections))
        for name in sorted(sections):
            header += text(name) + struct.pack("<QQ", len(sections[name]), zlib.crc32(sections[name]))
        values += b"".join(sections[name] for name in names if name in sections)
    checked = struct.pack("<QQ", 7, len(header)) + header
    return b"Mortise state\r\n\0" + struct.pack("<Q", zlib.crc32(checked)) + checked + values


REALS = [0., -1., 1e300, -1e-300, float("nan"), float("inf"), 1e16, 5e-324]
SIZES = [0, 1, 2, 255, 2 ** 31, 2 ** 32 - 1, 2 ** 32, 2 ** 40, 2 ** 63, 2 ** 64 - 1]


def bytes_changed(random, content, of_file):
    """One of the ways in which bytes go wrong."""
    if not content:
        return b"\0" * random.randrange(9)
    at = random.randrange(len(content) if random.random() < 0.7 else min(len(content), 200))
    how = random.randrange(8)
    if how == 0:
        return content[:at] + bytes([content[at] ^ (1 << random.randrange(8))]) + content[at + 1:]
    if how == 1:
        return content[:at]
    if how == 2:
        return content + bytes(random.randrange(256) for _ in range(random.choice([1, 8, 100])))
    if how == 3:
        n = random.choice([1, 8, 64, 512])
        return content[:at] + b"\0" * n + content[at + n:]
    if how == 4:
        n = random.choice([1, 8, 64])
        return content[:at] + content[at + n:]
    if how == 5:
        start = random.randrange(len(content))
        return content[:at] + content[start:start + 64] + content[at + 64:]
    at -= at % 8 if of_file or random.random() < 0.5 else at % 4
    new = struct.pack("<d", random.choice(REALS)) if how == 6 else struct.pack("<Q", random.choice(SIZES))
    return content[:at] + new + content[at + 8:]


def words_changed(random, content):
    """Within what is text: numbers, words, brackets."""
    words = [b"0", b"-1", b"null", b"1e999", b"1e300", b"[]", b"{}", b"\"\"", b"true", b"18446744073709551616", b"nan", b"..", b"[[[["]
    at = [i for i, c in enumerate(content) if c in b"0123456789\"[]{},:."]
    if not at:
        return content
    i = random.choice(at)
    if random.random() < 0.5:
        import re
        numbers = list(re.finditer(rb"-?\d+(\.\d+)?(e[-+]?\d+)?|\"[^\"]*\"", content))
        if numbers:
            chosen = random.choice(numbers)
            other = random.choice(numbers).group() if random.random() < 0.5 else random.choice(words)
            return content[:chosen.start()] + other + content[chosen.end():]
    return content[:i] + random.choice(words) + content[i + 1:]


def draw(random, bases):
    name = random.choice(list(bases))
    return name, [(random.choices(["raw", "section", "words", "exchange", "header", "file"], [2, 8, 4, 3, 2, 1])[0], random.getrandbits(32))
                  for _ in range(random.choice([1, 1, 1, 2, 3]))]


def apply(random_of, bases, base, operations):
    version, names, ranks = bases[base].version, list(bases[base].names), [dict(r) for r in bases[base].ranks]
    others = [bases[b] for b in bases if b != base]
    content = None
    for kind, seed in operations:
        random = random_of(seed)
        if kind == "file":
            content = random.choice(others).content
        if kind in ("raw", "file"):
            continue
        sections = random.choice(ranks) if ranks else {}
        name = random.choice(sorted(sections)) if sections else None
        if kind == "section" and name is not None:
            for _ in range(random.choice([1, 1, 4])):
                sections[name] = bytes_changed(random, sections[name], False)
        elif kind == "words" and b"run" in sections:
            name = b"adaptivity" if b"adaptivity" in sections and random.random() < 0.5 else b"run"
            sections[name] = words_changed(random, sections[name])
        elif kind == "exchange" and name is not None:
            other = random.choice(others)
            of_other = random.choice(other.ranks)
            own = random.random()
            if own < 0.5 and name in of_other:
                sections[name] = of_other[name]
            elif own < 0.7:
                sections[name] = sections[random.choice(sorted(sections))]
            else:
                del sections[name]
        elif kind == "header":
            how = random.randrange(6)
            if how == 0:
                version = random.choice([b"", b"0.0.0", b"\xff" * 10, version + b"1"])
            elif how == 1 and names:
                names.append(random.choice(names))
            elif how == 2 and names:
                names.pop(random.randrange(len(names)))
            elif how == 3:
                ranks.append(dict(random.choice(ranks)) if ranks else {})
            elif how == 4:
                random.shuffle(names)
            elif ranks:
                ranks.pop()
    content = content if content is not None else pack(version, names, ranks)
    for kind, seed in operations:
        if kind == "raw":
            content = bytes_changed(random_of(seed), content, True)
    return content

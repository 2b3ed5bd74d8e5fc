"""A page of doc/measurements that several runs write, each its own part."""
import os

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def write_part(page, name, text):
    """Replace the text between the marks <!-- name --> and <!-- end --> of a page."""
    path = os.path.join(TOP, "doc", "measurements", page)
    with open(path) as file:
        before, rest = file.read().split(f"<!-- {name} -->", 1)
    with open(path, "w") as file:
        file.write(f"{before}<!-- {name} -->\n\n{text.strip()}\n\n{rest[rest.index('<!-- end -->'):]}")

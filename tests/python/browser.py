"""Proves that a browser shows the report: its tables, charts and pictures, and no error. Skipped where there is no Chromium:
browser.py MORTISE SOURCE_DIRECTORY"""

import pathlib
import re
import shutil
import subprocess
import sys

from verdict import end, verdict

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
chromium = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
if not chromium:
    print("skipped: there is no chromium (Debian's package chromium)")
    sys.exit(77)


def browse(*options):
    return subprocess.run([chromium, "--headless", "--no-sandbox", "--disable-gpu", "--user-data-dir=" + str(pathlib.Path("profile").resolve()),
                           "--enable-logging=stderr", "--v=0", *options, page.resolve().as_uri()], capture_output=True, text=True, timeout=100)


subprocess.run([program, "--output", "steps", str(source / "prm/shrink_fit_torque.prm"), "--set", "Output/Fields="], check=True, capture_output=True)
subprocess.run([program, "--report", "steps"], check=True, capture_output=True)
page = pathlib.Path("steps/report.html")
# what the browser makes of it: sizes say that it is drawn
script = """<script>
addEventListener("load", () => {
  const drawn = s => [...document.querySelectorAll(s)].filter(e => e.getBoundingClientRect().width > 100).length;
  const folded = [...document.querySelectorAll("details")]; folded.forEach(d => d.open = true);
  document.body.dataset.found = [drawn("table"), drawn("svg"), document.images.length,
    [...document.images].filter(i => i.naturalWidth > 100).length, document.documentElement.scrollWidth <= innerWidth].join(" ");
});</script>"""
picture = '<img alt="dot" src="data:image/svg+xml;utf8,<svg xmlns=%22http://www.w3.org/2000/svg%22 width=%22200%22 height=%229%22/>">'
text = page.read_text()
n_tables, n_charts, n_images = text.count("<table"), text.count("<svg"), text.count("<img")
page = pathlib.Path("steps/seen.html")
page.write_text(text.replace("</main>", picture.replace("<", "<", 1) + "</main>" + script))
done = browse("--dump-dom")
found = re.search(r'data-found="([^"]*)"', done.stdout)
found = found.group(1).split() if found else []
verdict(found[:2] == [str(n_tables), str(n_charts)] and n_tables > 8 and n_charts > 4, "all tables and charts are drawn",
        f"{found} of {n_tables} and {n_charts}: {done.stderr[-500:]}")
verdict(found[2:4] == [str(n_images + 1)] * 2, "all pictures", found)
verdict(found[4:] == ["true"], "the page is as wide as the window", found)
console = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
verdict(not console, "no errors on the console", console)
page.write_text(page.read_text().replace("</main>", "</main><script>nothing()</script>"))
verdict("CONSOLE" in browse("--dump-dom").stderr, "which this test would see")
end()

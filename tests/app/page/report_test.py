"""Opens a report of palpa-cli in Chromium: on wide and narrow screens, dark, and on paper.

Arguments: the program palpa-cli, the folder of the example projects. Needs a display.
"""

import base64
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from browser import Browser  # noqa: E402  (beside this file, which is run as a program)

cli, projects = sys.argv[1:3]
folder = tempfile.TemporaryDirectory()
file = pathlib.Path(folder.name) / "report.html"


compared = pathlib.Path(folder.name) / "compared.html"


def report(width, height, **options):
    return Browser(file, width, height, ready="document.images.length > 0", **options)


class ReportInABrowser(unittest.TestCase):
    def test_shows_its_pictures_and_asks_for_nothing(self):
        with report(1280, 900) as page:
            sizes = page.evaluate("[...document.images].map((image) => image.naturalWidth)")
            self.assertEqual(sizes, [1200] * 4)
            self.assertEqual(page.problems, [])
            self.assertEqual(page.evaluate("document.title"), "box: report of touches")

    def test_fits_screens_of_all_widths(self):
        for width in (320, 390, 700, 768, 1280, 1920):
            with self.subTest(width=width), report(width, 800) as page:
                self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), width)
                # Nothing is cut off inside either.
                cut = page.evaluate("[...document.querySelectorAll('td, th, h1, h2, img')].filter("
                                    "(each) => each.getBoundingClientRect().right > innerWidth"
                                    ").map((each) => each.textContent)")
                self.assertEqual(cut, [])

    def test_names_stand_before_numbers_on_a_phone(self):
        with report(390, 800, touch=True) as page:
            shown = page.evaluate("getComputedStyle(document.querySelector('.cases td'), '::before')"
                                  ".content")
            self.assertEqual(shown, '"Kind and place"')

    def test_is_light_and_dark(self):
        def brightness(page):
            colour = page.evaluate("getComputedStyle(document.body).backgroundColor")
            return sum(map(int, re.findall(r"\d+", colour)[:3])) / 3
        with report(800, 600) as page:
            self.assertGreater(brightness(page), 230)
        with report(800, 600, dark=True) as page:
            self.assertLess(brightness(page), 40)

    def test_prints_every_state_on_one_page(self):
        with report(1280, 900, dark=True) as page:
            # A4.
            printed = base64.b64decode(page.call("Page.printToPDF", preferCSSPageSize=True,
                                                 paperWidth=8.27, paperHeight=11.69)["data"])
            self.assertTrue(printed.startswith(b"%PDF"))
            pages = len(re.findall(rb"/Type\s*/Page\b", printed))
            # Touches; model; two touches; together; notices and assumptions.
            self.assertIn(pages, (5, 6, 7))


class ComparisonInABrowser(unittest.TestCase):
    def test_both_pictures_have_one_scale_of_colours(self):
        with Browser(compared, 1280, 900, ready="document.images.length > 0") as page:
            self.assertEqual(page.problems, [])
            # The colour bar with its numbers is the same; the bodies are not.
            differing = page.evaluate("""(() => {
                const pixels = [...document.images].map((image) => {
                    const canvas = document.createElement('canvas');
                    canvas.width = image.naturalWidth; canvas.height = image.naturalHeight;
                    const context = canvas.getContext('2d');
                    context.drawImage(image, 0, 0);
                    return (x, y, width, height) => context.getImageData(x, y, width, height).data;
                });
                return [[930, 245, 60, 385], [100, 150, 700, 550]].map((place) => {
                    const [a, b] = pixels.map((of) => of(...place));
                    return a.reduce((sum, value, k) => sum + (value !== b[k]), 0);
                });
            })()""")
            self.assertEqual(differing[0], 0)
            self.assertGreater(differing[1], 1000)

    def test_pictures_stand_side_by_side_where_there_is_room(self):
        for width, beside in ((390, False), (1280, True)):
            with Browser(compared, width, 900, ready="document.images.length > 0") as page:
                tops = page.evaluate("[...document.images].map((image) => image.offsetTop)")
                self.assertEqual(tops[0] == tops[1], beside)
                self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), width)


if __name__ == "__main__":
    subprocess.run([cli, "report", f"{projects}/box.json", "-o", str(file), "--quiet"], check=True)
    other = pathlib.Path(folder.name) / "other.json"
    commands = pathlib.Path(folder.name) / "commands.json"
    commands.write_text(json.dumps([{"command": "move_points", "by_mm": [0, 0, 6],
                                     "points": {"sphere_mm": {"center": [0, 0, 20], "radius": 16}}}]))
    subprocess.run([cli, "edit", f"{projects}/box.json", "--commands", str(commands), "-o",
                    str(other), "--quiet"], check=True)
    subprocess.run([cli, "compare", f"{projects}/box.json", str(other), "-o", str(compared),
                    "--quiet"], check=True)
    unittest.main(argv=sys.argv[:1])

"""Touches an exported page in Chromium: mouse, finger, keys, sizes of the window, dark.

Arguments: the program palpa-cli, the folder of the example projects, and optionally a folder for pictures.
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from browser import Browser  # noqa: E402  (beside this file, which is run as a program)

cli, projects = sys.argv[1:3]
pictures = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
folder = tempfile.TemporaryDirectory()
file = pathlib.Path(folder.name) / "touch.html"

FORCE = re.compile(r"([\d.]+) ± ([\d.]+) N")


class Page(Browser):
    def __init__(self, width=1280, height=800, **options):
        super().__init__(file, width, height, **options)

    def middle(self):
        """Of the body, in pixels of the window."""
        box = self.evaluate("(() => { const b = page.canvas.getBoundingClientRect();"
                            " return [b.left + b.width / 2, b.top + b.height / 2]; })()")
        return tuple(box)

    def shown(self):
        self.frame()
        return self.evaluate("document.getElementById('total').textContent")

    def force(self):
        """The shown force and its error, N."""
        found = FORCE.fullmatch(self.shown())
        assert found, self.shown()
        return float(found[1]), float(found[2])

    def touches(self):
        return self.evaluate("page.touches.length")

    def keep(self, name):
        if pictures:
            self.picture(pictures / (name + ".png"))


class TouchablePage(unittest.TestCase):
    def assert_quiet(self, page):
        self.assertEqual(page.problems, [])

    def test_mouse_grabs_and_lets_go(self):
        with Page() as page:
            self.assertEqual(page.shown(), "touch the body")
            x, y = page.middle()
            page.press(x, y)
            page.drag(x + 30, y)
            small, error = page.force()
            page.keep("grab")
            page.drag(x + 60, y)
            large, _ = page.force()
            # The body is linear: twice the way, twice the force.
            self.assertGreater(small, error)
            self.assertAlmostEqual(large / small, 2, delta=0.1)
            page.release(x + 60, y)
            self.assertEqual(page.touches(), 0)
            self.assertEqual(page.shown(), "touch the body")
            self.assert_quiet(page)

    def test_background_turns_the_view(self):
        with Page() as page:
            before = page.evaluate("JSON.stringify(page.view.axes())")
            page.press(10, 300)
            page.drag(80, 330)
            page.release(80, 330)
            page.frame()
            self.assertEqual(page.touches(), 0)
            self.assertNotEqual(page.evaluate("JSON.stringify(page.view.axes())"), before)
            self.assert_quiet(page)

    def test_finger_presses_on_a_phone(self):
        with Page(390, 844, touch=True) as page:
            page.evaluate("document.querySelector('input[value=press]').click()")
            x, y = page.middle()
            page.touch("Start", (x, y))
            force, error = page.force()
            self.assertGreater(force, error)
            page.touch("Move", (x + 8, y + 5))
            self.assertGreater(page.force()[0], 0)
            page.keep("phone")
            page.touch("End")
            page.frame()
            self.assertEqual(page.touches(), 0)
            self.assert_quiet(page)

    def test_kept_touches_act_together(self):
        with Page() as page:
            page.evaluate("document.getElementById('hold').click()")
            x, y = page.middle()
            for dx in (-40, 40):
                page.press(x + dx, y)
                page.drag(x + dx, y - 15)
                page.release(x + dx, y - 15)
            page.frame()
            self.assertEqual(page.touches(), 2)
            rows = page.evaluate("document.querySelectorAll('#touches tbody tr').length")
            self.assertEqual(rows, 2)
            page.keep("two")
            page.evaluate("document.getElementById('release').click()")
            page.frame()
            self.assertEqual(page.touches(), 0)
            self.assert_quiet(page)

    def test_keys_alone(self):
        with Page() as page:
            page.evaluate("page.canvas.focus()")
            page.key("Enter", 13, "\r")
            page.frame()
            self.assertEqual(page.touches(), 1)
            page.key("PageDown", 34)
            inwards, _ = page.force()
            page.key("PageDown", 34)
            deeper, _ = page.force()
            self.assertAlmostEqual(deeper / inwards, 2, delta=0.1)
            page.key("ArrowRight", 39)
            self.assertNotEqual(page.force()[0], deeper)
            page.key("Escape", 27)
            page.frame()
            self.assertEqual(page.touches(), 0)
            self.assert_quiet(page)

    def test_fits_every_window(self):
        for width, height in ((1280, 800), (390, 844), (844, 390), (1920, 1080)):
            for dark in (False, True):
                with self.subTest(width=width, dark=dark), Page(width, height, dark=dark) as page:
                    page.frame()
                    page.keep(f"{width}{'-dark' if dark else ''}")
                    self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), width)
                    box = page.evaluate("(() => { const b = page.canvas.getBoundingClientRect();"
                                        " return [b.width, b.height]; })()")
                    self.assertGreater(min(box), 200)
                    colour = page.evaluate("getComputedStyle(document.body).backgroundColor")
                    brightness = sum(map(int, re.findall(r"\d+", colour)[:3])) / 3
                    self.assertEqual(brightness < 128, dark)
                    self.assert_quiet(page)


if __name__ == "__main__":
    subprocess.run([cli, "export", str(pathlib.Path(projects) / "fingertip-pad.json"), "-o", str(file),
                    "--places", "60"], check=True)
    unittest.main(argv=sys.argv[:1])

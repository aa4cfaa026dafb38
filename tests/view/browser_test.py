"""The page of `airsim360 view` in a real browser: clicks against the label files, keys, names for screen readers, both modes."""
import functools
import http.server
import json
import math
import pathlib
import random
import shutil
import sys
import tempfile
import threading
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "end_to_end"))
import axe
from browser import Browser
from program import read_ids, read_json
from viewer import Viewer, make_dataset, run

ROOM = pathlib.Path(tempfile.mkdtemp(prefix="airsim360_browser_test_"))
BROWSER = None


def setUpModule():
    global BROWSER
    make_dataset(ROOM / "data")
    make_dataset(ROOM / "other", "--seed", 3)
    BROWSER = Browser()


def tearDownModule():
    BROWSER.close()
    shutil.rmtree(ROOM)


class PageTest(unittest.TestCase):
    arguments = ()

    @classmethod
    def setUpClass(cls):
        cls.viewer = Viewer(*cls.arguments)
        cls.page = BROWSER

    @classmethod
    def tearDownClass(cls):
        cls.viewer.stop()

    def open(self, hash=""):
        self.page.said.clear()
        self.page.open(f"{self.viewer.address}/{hash}")
        self.page.wait("window.airsim360?.first")
        self.shown()

    def set(self, id, value):
        self.page.run(f"{{ const e = document.getElementById('{id}'); e.type === 'checkbox' ? e.checked = {json.dumps(value)} : e.value = {json.dumps(value)};"
                      "e.dispatchEvent(new Event('input')); e.dispatchEvent(new Event('change')); }")
        self.settle()

    def settle(self):
        self.page.run("airsim360.refresh()")
        self.shown()

    def shown(self):
        """What was laid out is on the screen: the picture learns its size from the browser a frame later."""
        self.page.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def assert_usable(self, mode):
        """Nothing serious that axe-core finds."""
        if axe.source() is None:
            self.skipTest("npm cannot get axe-core")
        self.assertEqual(axe.findings(self.page), [], mode)

    def text(self, id):
        return self.page.run(f"document.getElementById('{id}').textContent")

    def canvas(self):
        return self.page.run("(b => ({x: b.x, y: b.y, width: b.width, height: b.height}))(document.querySelector('#pane-a canvas').getBoundingClientRect())")

    def color(self, dx=0, dy=0):
        """Of the pixel of the screen beside the middle of the canvas."""
        return self.page.run(f"(c => {{ airsim360.main.panorama.paint(); const g = c.getContext('webgl2'), p = new Uint8Array(4); g.readPixels(c.width / 2 + {dx}, c.height / 2 - {dy}, 1, 1, g.RGBA, g.UNSIGNED_BYTE, p); return [...p]; }})"
                             "(document.querySelector('#pane-a canvas'))")


class RecordedTest(PageTest):
    arguments = (ROOM / "data",)

    def test_a_hundred_clicks_give_the_entities_of_the_label_files(self):
        self.open()
        random.seed(7)
        box = self.canvas()
        wrong = []
        for n in range(100):
            frame = random.randrange(6)
            # Every tenth at the seam, every tenth at a pole, the rest anywhere on the picture.
            x, y = random.randrange(256), random.randrange(128)
            if n % 10 == 0:
                x = random.choice([0, 255])
            if n % 10 == 1:
                y = random.choice([0, 1, 126, 127])
            fov = random.uniform(0.3, 1.6)
            flat = n % 4 == 3
            theta, phi = 2 * math.pi * ((x + 0.5) / 256 - 0.5), math.pi * (0.5 - (y + 0.5) / 128)
            # The pixel lies somewhere off the middle of the screen: where, by the equations of the lens.
            yaw, pitch = theta + random.uniform(-0.2, 0.2) * fov, max(-math.pi / 2, min(math.pi / 2, phi + random.uniform(-0.2, 0.2) * fov))
            ray = (math.cos(phi) * math.sin(theta - yaw), math.sin(phi), math.cos(phi) * math.cos(theta - yaw))
            right, up, ahead = ray[0], ray[1] * math.cos(pitch) - ray[2] * math.sin(pitch), ray[2] * math.cos(pitch) + ray[1] * math.sin(pitch)
            focal = box["height"] / 2 / math.tan(fov / 2)
            sx, sy = box["width"] / 2 + focal * right / ahead, box["height"] / 2 - focal * up / ahead
            if flat:
                yaw, pitch, sx, sy = theta, phi, box["width"] / 2, box["height"] / 2
            self.page.run(f"airsim360.picked = null; document.getElementById('flat').checked = {str(flat).lower()}; airsim360.main.panorama.flat = {str(flat).lower()};"
                          f"airsim360.main.look.set({yaw}, {pitch}, {fov}); airsim360.showFrame({frame})")
            self.page.click(box["x"] + sx, box["y"] + sy)
            picked = self.page.wait("airsim360.picked")
            labels = read_ids(ROOM / f"data/entity/{frame:06}.png")
            if (picked["x"], picked["y"]) != (x, y) or picked["id"] != labels[y][x]:
                wrong.append((n, frame, (x, y), picked, labels[y][x]))
        self.assertEqual(wrong, [])
        entities = read_json(ROOM / "data/entities.json")
        self.assertIn(entities[str(picked["id"])]["name"], self.text("card"))
        self.assertEqual(self.page.problems(), [])

    def test_the_screen_shows_the_pixel_that_a_click_names(self):
        self.open("#show=entity&fov=0.3")
        self.set("opacity", "1")
        random.seed(11)
        for _ in range(12):
            x, y = random.randrange(256), random.randrange(3, 125)
            yaw, pitch = 2 * math.pi * ((x + 0.5) / 256 - 0.5), math.pi * (0.5 - (y + 0.5) / 128)
            self.page.run(f"airsim360.main.look.set({yaw}, {pitch}, 0.3); airsim360.refresh()")
            self.settle()
            id = read_ids(ROOM / "data/entity/000000.png")[y][x]
            wanted = self.page.run(f"import('./overlay.js').then(o => o.idColor({id}))")
            self.assertEqual(self.color()[:3], wanted, (x, y))

    def test_the_horizon_is_no_exception(self):
        # Where a driver's arc tangent of 0 is wrong, a line of the sky goes through the middle of the screen.
        self.open("#show=entity&yaw=0&pitch=0&fov=0.3")
        self.set("opacity", "1")
        labels = read_ids(ROOM / "data/entity/000000.png")
        near = {labels[y][x] for y in (63, 64) for x in range(110, 146)}
        wanted = self.page.run(f"import('./overlay.js').then(o => {sorted(near)}.map(o.idColor))")
        for dy in range(-2, 3):
            for dx in range(-200, 201, 40):
                self.assertIn(self.color(dx, dy)[:3], wanted, (dx, dy))

    def test_every_product_is_an_overlay_and_nothing_comes_from_elsewhere(self):
        self.open()
        products = self.page.run("[...document.getElementById('product').options].map(o => o.value)")
        self.assertEqual(set(products), {"", "range", "semantic", "entity", "normal", "flow", "coverage"})
        seen = set()
        for product in products:
            self.set("product", product)
            seen.add(tuple(self.color(40, 30)))
            self.assertNotEqual(self.text("legend"), "", product)
        self.assertGreaterEqual(len(seen), 6)
        self.assertEqual(self.page.problems(), [])
        self.assertTrue(all(a.startswith((self.viewer.address, "data:")) for a in self.page.addresses()))

    def test_a_search_finds_the_frames_that_the_labels_and_ranges_say(self):
        self.open()
        entities = read_json(ROOM / "data/entities.json")
        box = next(int(id) for id, e in entities.items() if e["name"] == "box")
        # Nearest range of the box of each frame, by the library that wrote nothing of the page.
        self.set("question", "box within 100 m")
        self.page.run("document.getElementById('search-form').requestSubmit()")
        self.page.wait("/^\\d+ frames$/.test(document.getElementById('search-state').textContent)")
        wanted = [i for i in range(6) if any(box in row for row in read_ids(ROOM / f"data/entity/{i:06}.png"))]
        self.assertEqual(self.page.run("airsim360.list.rows"), wanted)
        least = self.page.run("[...document.querySelectorAll('#hits button')].map(b => Number(/([\\d.]+) m$/.exec(b.textContent)[1]))")
        # The box is the unit cube about (3, 0, 0.5): no pixel is nearer than its nearest point, nor much farther.
        for frame, metres in zip(wanted, least):
            p = json.loads((ROOM / "data/frames.jsonl").read_text().splitlines()[frame])["X_WC"]["p"]
            true = math.dist(p, [max(2.5, min(3.5, p[0])), max(-0.5, min(0.5, p[1])), max(0, min(1, p[2]))])
            self.assertGreaterEqual(metres, true - 0.06)
            self.assertLess(metres, true + 0.35)
        # A hit shows the frame and looks at the thing.
        self.page.run("document.querySelector('#hits button').click()")
        self.page.wait(f"airsim360.picked?.id === {box} && airsim360.frame === {wanted[0]} && airsim360.box.known")
        self.page.run("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        seen = self.page.run("(l => l.pixelAt(l.width / 2, l.height / 2, 256, 128))(airsim360.main.look)")
        self.assertEqual(read_ids(ROOM / f"data/entity/{wanted[0]:06}.png")[seen[1]][seen[0]], box)
        self.set("question", "dragon within 2 m")
        self.page.run("document.getElementById('search-form').requestSubmit()")
        self.page.wait("document.getElementById('search-state').textContent === 'No thing is called \"dragon\".'")
        # What has some of the words is offered, and found by a click.
        self.set("question", "yellow box within 100 m")
        self.page.run("document.getElementById('search-form').requestSubmit()")
        self.page.wait("document.getElementById('search-state').textContent.endsWith('Did you mean:')")
        self.page.run("[...document.querySelectorAll('#hits button')].find(b => b.textContent === 'box').click()")
        self.page.wait("document.getElementById('search-state').textContent.endsWith('frames')")
        self.assertEqual(self.page.run("document.getElementById('question').value"), "box within 100 m")

    def test_everyday_words_are_understood(self):
        self.open()
        for text, words, within in [("mailbox within 20 m", ["post", "box"], 20), ("frames with a red bench", ["red", "bench"], None), ("People < 3.5 m", ["person"], 3.5), ("", [], None)]:
            said = self.page.run(f"import('./search.js').then(s => s.parseQuestion({json.dumps(text)}))")
            self.assertEqual((said["words"], said.get("within") or None), (words, within), text)

    def test_the_box_of_a_thing_is_where_the_world_has_it(self):
        self.open()
        labels = read_ids(ROOM / "data/entity/000000.png")
        entities = read_json(ROOM / "data/entities.json")
        box = next(int(id) for id, e in entities.items() if e["name"] == "box")
        x, y = next((x, y) for y in range(128) for x in range(256) if labels[y][x] == box)
        self.page.run(f"airsim360.pick(airsim360.main, {x}, {y})")
        self.page.wait("airsim360.box?.known")
        low, high = self.page.run("[airsim360.box.low, airsim360.box.high]")
        for a, (least, most) in enumerate([(2.5, 3.5), (-0.5, 0.5), (0, 1)]):
            self.assertGreaterEqual(low[a], least - 0.02)
            self.assertLessEqual(high[a], most + 0.02)

    def test_filters_darken_what_they_leave_out(self):
        self.open("#show=semantic")
        self.set("opacity", "1")
        before = self.color()
        self.page.run("document.querySelector('#legend input').click()")
        for box in range(self.page.run("document.querySelectorAll('#legend input').length")):
            self.page.run(f"{{ const b = document.querySelectorAll('#legend input')[{box}]; if (b.checked) b.click(); }}")
            self.settle()
        self.assertNotEqual(self.color(), before)
        self.open()
        self.set("low", "100")
        self.assertLess(sum(self.color()[:3]), 3 * 110)

    def test_everything_is_reached_by_keys(self):
        self.open()
        self.page.run("document.querySelector('#pane-a canvas').focus()")
        yaw = self.page.run("airsim360.main.look.yaw")
        self.page.key("ArrowRight")
        self.assertGreater(self.page.run("airsim360.main.look.yaw"), yaw)
        fov = self.page.run("airsim360.main.look.fov")
        self.page.key("+")
        self.assertLess(self.page.run("airsim360.main.look.fov"), fov)
        self.page.key("Enter")
        self.page.wait("!document.getElementById('only-frames').hidden")  # the card's last button, which waits for the index
        self.page.key(".")
        self.page.wait("airsim360.frame === 1")
        self.page.run("document.getElementById('frame-list').focus()")
        self.page.key("End")
        self.page.wait("airsim360.frame === 5")
        self.page.key("ArrowUp")
        self.page.wait("airsim360.frame === 4")
        # Tab comes by every control that is shown, once, and out again.
        self.page.run("document.activeElement.blur()")
        name = "const name = e => e === document.body ? '' : e.tagName + e.id + [...document.querySelectorAll('*')].indexOf(e);"
        wanted = self.page.run(f"(() => {{ {name} return [...document.querySelectorAll('a[href], button, input, select, summary, canvas[tabindex], [role=listbox]')]"
                               ".filter(e => e.checkVisibility() && !e.disabled).map(name); })()")
        reached = set()
        for _ in range(len(wanted) + 5):
            self.page.key("Tab")
            reached.add(self.page.run(f"(() => {{ {name} return name(document.activeElement); }})()"))
        self.assertEqual(reached - {""}, set(wanted))

    def test_every_control_has_a_name_that_a_screen_reader_says(self):
        self.open()
        self.page.call("Accessibility.enable")
        nodes = self.page.call("Accessibility.getFullAXTree")["nodes"]
        for node in nodes:
            role = node.get("role", {}).get("value")
            if not node.get("ignored") and role in {"button", "checkbox", "combobox", "slider", "searchbox", "spinbutton", "listbox", "option", "application", "image", "DisclosureTriangle", "link"}:
                self.assertTrue(node.get("name", {}).get("value"), node)
        self.assertEqual(self.page.run("document.documentElement.lang"), "en")
        self.page.call("Accessibility.disable")

    def test_axe_finds_nothing_serious_in_a_dataset(self):
        self.open("#show=semantic")
        self.page.run("document.getElementById('help-button').click(); airsim360.pick(airsim360.main, 128, 100)")
        self.page.wait("airsim360.picked")
        self.set("question", "box within 100 m")
        self.page.run("document.getElementById('search-form').requestSubmit()")
        self.page.wait("/^\\d+ frames$/.test(document.getElementById('search-state').textContent)")
        self.assert_usable("dataset")
        self.page.resize(360, 740)
        try:
            self.assert_usable("dataset on a phone")
        finally:
            self.page.resize(1280, 800)

    def test_at_phone_width_and_at_200_percent_nothing_is_cut_off(self):
        for width, height in [(360, 740), (640, 400)]:
            self.page.resize(width, height)
            try:
                self.open()
                self.assertLessEqual(self.page.run("document.documentElement.scrollWidth"), width)
                self.assertGreater(self.canvas()["height"], 150)
            finally:
                self.page.resize(1280, 800)

    def test_the_address_brings_back_what_was_seen(self):
        self.open("#frame=3&yaw=1.2&pitch=-0.3&fov=0.9&show=range")
        self.assertEqual(self.page.run("[airsim360.frame, airsim360.product]"), [3, "range"])
        self.assertAlmostEqual(self.page.run("airsim360.main.look.yaw"), 1.2, 3)
        self.open("#frame=99999&yaw=x&pitch=1e999&fov=-3&show=nothing")
        self.assertEqual(self.page.run("[airsim360.frame, airsim360.product, airsim360.main.look.pitch]"), [5, "", 0])


class CompareTest(PageTest):
    arguments = (ROOM / "data", "--compare", ROOM / "other")

    def test_two_datasets_are_looked_at_together(self):
        self.open()
        self.page.run("airsim360.panes[1].panorama.turnTo(0.7, 0.2, 0.8)")
        self.assertEqual(self.page.run("[airsim360.main.look.yaw, airsim360.main.look.pitch, airsim360.main.look.fov]"), [0.7, 0.2, 0.8])
        self.set("product", "difference")
        self.assertEqual(self.page.problems(), [])
        self.assertEqual(self.page.run("airsim360.panes.map(p => p.box.querySelector('.pane-name').textContent)"), ["data", "other"])
        self.assert_usable("side by side")


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


class ExportTest(unittest.TestCase):
    def test_the_export_works_from_a_server_of_files(self):
        done = run("view", ROOM / "data", "--export", ROOM / "site")
        self.assertEqual(done.returncode, 0, done.stderr)
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=ROOM / "site"))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            BROWSER.said.clear()
            BROWSER.open(f"http://127.0.0.1:{server.server_port}/index.html#show=range")
            BROWSER.wait("window.airsim360?.first")
            BROWSER.run("airsim360.pick(airsim360.main, 128, 64)")
            BROWSER.wait("airsim360.picked")
            self.assertEqual(BROWSER.problems(), [])
        finally:
            server.shutdown()
            server.server_close()


class LiveTest(PageTest):
    arguments = ("--world", "box_room", "--record", ROOM / "kept")

    def test_a_key_flies_the_drone_and_a_click_names_what_is_there(self):
        self.open()
        self.page.wait("airsim360.live.picture?.number > 3")
        start = self.page.run("airsim360.live.picture.p[2]")
        self.page.call("Input.dispatchKeyEvent", type="keyDown", key="r", windowsVirtualKeyCode=82)
        self.page.wait(f"airsim360.live.picture.p[2] > {start} + 0.3")
        self.page.call("Input.dispatchKeyEvent", type="keyUp", key="r", windowsVirtualKeyCode=82)
        box = self.canvas()
        self.page.run("airsim360.main.panorama.turnTo(0, -1.5)")
        self.page.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        picked = self.page.wait("airsim360.picked")
        self.assertIn("floor", self.text("card"))
        # Almost straight down the range is the height of the picture that was clicked.
        self.assertAlmostEqual(picked["range"] * math.sin(1.5), picked["p"][2], delta=0.02)
        self.assertEqual(self.page.problems(), [])

    def test_products_are_switched_while_it_flies(self):
        self.open()
        for product in self.page.run("[...document.getElementById('product').options].map(o => o.value)"):
            self.page.run(f"document.getElementById('product').value = '{product}'; document.getElementById('product').dispatchEvent(new Event('change'))")
            before = self.page.run("airsim360.live.picture.number")
            self.page.wait(f"airsim360.live.picture.number > {before} + 3")
            if product:
                self.assertTrue(self.page.run(f"Boolean(airsim360.live.picture.planes['{product}'])"), product)
        self.assertEqual(self.page.problems(), [])


    def test_names_come_after_the_first_picture(self):
        self.open()
        asked = self.page.wait("performance.getEntriesByType('resource').find(e => e.name.endsWith('/entities.json'))?.startTime")
        self.assertGreater(asked, self.page.run("airsim360.first"))

    def test_a_thing_is_found_by_its_name_and_the_drone_flies_there(self):
        self.open()
        self.page.wait("airsim360.live.picture?.number > 3")
        self.page.key("/")
        for letter in "bux":
            self.page.key(letter)
        self.page.key("Enter")
        self.page.wait("document.getElementById('find-state').textContent === 'No thing is called \"bux\".'")
        self.page.run("document.getElementById('find-text').value = 'box'")
        self.page.key("Enter")
        self.page.wait("document.getElementById('found').textContent.startsWith('box · ')")
        self.assertIn("Namebox", self.text("card"))
        self.page.run("document.getElementById('fly-there').click()")
        self.page.wait("document.getElementById('fly-state').textContent === 'There: box'", 90)
        centre, p = self.page.run("[airsim360.box.low.map((v, a) => (v + airsim360.box.high[a]) / 2), airsim360.live.picture.p]")
        self.assertLess(math.dist(centre, p), 3 + 1.5)
        # Whoever takes the keys takes the drone.
        self.page.run("document.getElementById('fly-there').click()")
        self.page.wait("airsim360.live.finder.flying || document.getElementById('fly-state').textContent === 'There: box'")
        self.page.run("document.querySelector('#pane-a canvas').focus()")
        self.page.key("r")
        self.page.wait("!airsim360.live.finder.flying")
        self.assertEqual(self.page.problems(), [])

    def test_keys_that_are_held_steer_pictures_that_were_asked_for_before(self):
        self.open()
        self.page.wait("airsim360.live.picture?.number > 3")
        self.page.call("Input.dispatchKeyEvent", type="keyDown", key="q")
        told = self.page.run("airsim360.live.steered")
        self.page.run(f"window.hands = 0; airsim360.live.told = airsim360.live.tell; airsim360.live.tell = function (h, ...more) {{ window.hands = h.hands; this.told(h, ...more); }}; 0")
        self.page.wait(f"window.hands >= {told}")
        self.page.call("Input.dispatchKeyEvent", type="keyUp", key="q")
        self.assertEqual(self.page.problems(), [])

    def test_only_what_was_kept_can_be_saved(self):
        self.open()
        self.page.wait("airsim360.live.picture?.number > 3")
        self.assertTrue(self.page.run("airsim360.live.save.disabled"))
        self.page.run("[...document.querySelectorAll('#live button')].find(b => b.textContent === 'Keep this frame').click()")
        self.page.wait("!airsim360.live.save.disabled && airsim360.live.save.textContent === 'Save 1 frame'")


class EditorTest(PageTest):

    def edit(self):
        """Opens the page with its editor."""
        self.open()
        self.page.run("document.getElementById('trees').open = true")
        self.page.wait("document.querySelectorAll('#tree-graph [data-order]').length > 0")

    def labels(self):
        return self.page.run("[...document.querySelectorAll('#tree-graph [data-order] b')].map(e => e.textContent)")

    def press(self, id):
        """Presses a button, and waits for the server's answer: the text changes, or the page says what is wrong."""
        self.page.run(f"(() => {{ window.before = [airsim360.live.trees.xml, document.getElementById('tree-state').textContent]; document.getElementById('{id}').click(); }})()")
        self.page.wait("airsim360.live.trees.xml !== before[0] || document.getElementById('tree-state').textContent !== before[1]")

    def write(self, xml):
        self.page.run(f"(() => {{ const t = document.getElementById('tree-xml'); t.value = {json.dumps(xml)}; t.dispatchEvent(new Event('change')); }})()")

    def set_value(self, id, value):
        self.page.run(f"document.getElementById('{id}').value = {json.dumps(value)}")

    def draw(self, kind):
        self.page.run("document.getElementById('drawing').open = true")
        self.page.run(f"(() => {{ const k = document.getElementById('draw-kind'); k.value = '{kind}'; k.dispatchEvent(new Event('change')); }})()")

    def drawn(self):
        return self.page.run("document.getElementById('draw-text').value")

    def said(self, text):
        self.page.wait(f"document.getElementById('draw-state').textContent.startsWith({json.dumps(text)})")


class TreesTest(EditorTest):
    arguments = ("--world", "box_room", "--people", "2")

    def test_the_tree_of_a_person_is_drawn_and_the_nodes_that_run_glow(self):
        self.edit()
        self.assertIn("running", self.page.wait("[...document.querySelectorAll('#tree-graph .active')].map(e => e.getAttribute('aria-label')).join()"))
        # Every node that glows is below one that glows, up to the root.
        alone = "[...document.querySelectorAll('#tree-graph .active')].filter(e => e.getAttribute('aria-level') > 1 && !e.parentElement.parentElement.previousElementSibling.classList.contains('active')).length"
        self.assertEqual(self.page.run(alone), 0)
        self.assertEqual(self.page.problems(), [])

    def test_edited_by_buttons_and_by_hand_the_bytes_are_the_same_and_undo_brings_them_back(self):
        self.edit()
        name = self.page.run("document.getElementById('tree-name').value")
        plain = f'<root BTCPP_format="4"><BehaviorTree ID="{name}"><Sequence><SetState state="waving"/></Sequence></BehaviorTree></root>'
        self.write(plain)
        self.page.wait("airsim360.live.trees.xml.includes('<SetState state=\"waving\"/>')")
        first = self.page.run("airsim360.live.trees.xml")
        # By keys: down to SetState, then a Sleep after it.
        self.page.run("document.querySelector('#tree-graph [tabindex=\"0\"]').focus()")
        self.page.key("ArrowDown")
        self.page.wait("document.getElementById('node-title').textContent === 'SetState'")
        self.set_value("node-new", "Sleep")
        self.press("node-after")
        self.assertEqual(self.labels(), ["Sequence", "SetState", "Sleep"])
        self.page.run("(() => { const i = document.querySelector('#node-ports [name=msec]'); i.value = '2500'; i.dispatchEvent(new Event('change', {bubbles: true})); })()")
        self.page.wait("airsim360.live.trees.xml.includes('2500')")
        by_buttons = self.page.run("airsim360.live.trees.xml")
        (ROOM / "hand.xml").write_text(plain.replace("</Sequence>", '<Sleep\n  msec="2500"></Sleep></Sequence>'))
        self.assertEqual(run("people", "trees", ROOM / "hand.xml").stdout, by_buttons)
        self.write((ROOM / "hand.xml").read_text())
        self.page.run("airsim360.live.ask({do: 'palette'})")  # answers come in order
        self.assertEqual(self.page.run("airsim360.live.trees.xml"), by_buttons)
        for _ in range(2):
            self.press("tree-undo")
        self.assertEqual(self.page.run("airsim360.live.trees.xml"), first)
        self.press("tree-redo")
        self.assertIn("Sleep", self.labels())
        self.assertEqual(self.page.problems(), [])

    def test_an_applied_tree_is_followed_and_a_wrong_one_is_told(self):
        self.edit()
        name, person = self.page.run("['tree-name', 'tree-person'].map(id => document.getElementById(id).value)")
        self.write(f'<root BTCPP_format="4"><BehaviorTree ID="{name}"><Sequence><SetState state="wavin"/></Sequence></BehaviorTree></root>')
        self.page.wait("document.getElementById('tree-state').textContent.includes(\"did you mean 'waving'\")")
        self.write(f'<root BTCPP_format="4"><BehaviorTree ID="{name}"><Sequence><SetState state="waving" min_s="60" max_s="60" name="wave!"/></Sequence></BehaviorTree></root>')
        self.page.wait("airsim360.live.trees.xml.includes('wave!')")
        self.press("tree-apply")
        self.page.wait(f"document.getElementById('tree-state').textContent.startsWith('{person}: waving')")
        self.page.wait("[...document.querySelectorAll('#tree-graph .active b')].map(e => e.textContent).join() === 'Sequence,wave!'")
        self.assertEqual(self.page.problems(), [])

    def test_the_blackboard_and_changes_of_state_are_shown(self):
        self.edit()
        name, person = self.page.run("['tree-name', 'tree-person'].map(id => document.getElementById(id).value)")
        self.write(f'<root BTCPP_format="4"><BehaviorTree ID="{name}"><Sequence><SetBlackboard value="7.5" output_key="{{count}}"/><SetState state="waving" min_s="60" max_s="60" name="board"/></Sequence></BehaviorTree></root>')
        self.page.wait("airsim360.live.trees.xml.includes('board')")
        self.press("tree-apply")
        self.page.wait("document.getElementById('tree-board').textContent === 'count7.5'")
        self.assertFalse(self.page.run("document.getElementById('tree-board-none').checkVisibility()"))
        self.page.wait("document.getElementById('tree-letters').textContent.includes('→ waving')")
        self.page.run("(() => { const k = document.getElementById('tree-kind'); k.value = 'mission'; k.dispatchEvent(new Event('change')); })()")
        self.page.wait("document.getElementById('tree-letters-title').textContent === 'Log'")
        self.assertEqual(self.text("tree-board"), "")
        self.assertEqual(self.page.problems(), [])

    def test_an_area_drawn_on_the_map_is_the_yaml_that_the_commands_read(self):
        self.open()
        self.page.wait("airsim360.live.picture?.number > 3")
        self.page.run("document.getElementById('drawing').open = true")
        self.page.run("document.getElementById('map').scrollIntoView()")
        box = self.page.run("(b => ({x: b.x, y: b.y, width: b.width, height: b.height}))(document.getElementById('map').getBoundingClientRect())")
        scale = self.page.run("airsim360.map.scale()")
        for dx, dy in [(-1, -1), (1, -1), (1, 1), (-1, 1)]:
            self.page.click(box["x"] + box["width"] / 2 + dx * scale, box["y"] + box["height"] / 2 + dy * scale)
        self.page.wait("document.getElementById('draw-text').value.split('[').length === 6")
        self.page.wait("document.getElementById('draw-state').textContent === 'Valid: 1 area, 5 people. Commands read it with --people people.yaml.'")
        (ROOM / "drawn.yaml").write_text(self.page.run("document.getElementById('draw-text').value"))
        done = run("render", "--world", "box_room", "--people", ROOM / "drawn.yaml", "--size", "32x16", "--tier", "labels", "--out", ROOM / "drawn")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.page.run("document.getElementById('draw-undo').click()")
        self.page.wait("document.getElementById('draw-text').value.split('[').length === 5")
        self.assertEqual(self.page.problems(), [])

    def test_axe_finds_nothing_serious_in_a_live_world_with_everything_open(self):
        self.edit()
        self.page.run("airsim360.main.panorama.turnTo(0, -1.5)")
        self.page.run("airsim360.pick(airsim360.main, 128, 250)")
        self.page.wait("!document.getElementById('person-tools').hidden")
        for kind in ["area", "camera", "label", "lamp"]:
            self.draw(kind)
            self.assert_usable(f"live, drawing a {kind}")

    def test_every_control_of_a_live_world_is_reached_by_tab(self):
        self.edit()
        self.draw("lamp")
        self.page.run("document.activeElement.blur()")
        name = "const name = e => e === document.body ? '' : e.tagName + e.id + [...document.querySelectorAll('*')].indexOf(e);"
        wanted = self.page.run(f"(() => {{ {name} return [...document.querySelectorAll('a[href], button, input, select, textarea, summary, canvas[tabindex], [tabindex=\"0\"]')]"
                               ".filter(e => e.checkVisibility() && !e.disabled).map(name); })()")
        reached = set()
        for _ in range(len(wanted) + 8):
            self.page.key("Tab")
            reached.add(self.page.run(f"(() => {{ {name} return name(document.activeElement); }})()"))
        self.assertEqual(set(wanted) - reached, set())

    def test_every_control_of_the_editor_has_a_name_and_fits_a_phone(self):
        self.page.resize(360, 740)
        try:
            self.edit()
            for kind in ["area", "person", "route", "camera", "label", "lamp"]:
                self.draw(kind)
                self.assertLessEqual(self.page.run("document.documentElement.scrollWidth"), 360, kind)
        finally:
            self.page.resize(1280, 800)
        self.page.call("Accessibility.enable")
        for node in self.page.call("Accessibility.getFullAXTree")["nodes"]:
            role = node.get("role", {}).get("value")
            if not node.get("ignored") and role in {"button", "checkbox", "combobox", "slider", "textbox", "treeitem", "tree", "toolbar", "DisclosureTriangle"}:
                self.assertTrue(node.get("name", {}).get("value"), node)
        self.page.call("Accessibility.disable")


class MissionTest(EditorTest):
    """Nobody is in the way of the drone; the editor begins with a mission then."""
    arguments = ("--world", "box_room")

    def test_a_camera_a_label_and_a_lamp_that_are_drawn_are_files_that_the_commands_read(self):
        self.open()
        self.page.wait("airsim360.live.picture?.number > 3")
        # A camera looks where one looks: to the right and up, at the wall in the south. Mirrored it sees the north, turned down the floor.
        self.page.run("airsim360.main.panorama.turnTo(1.2, 0.3, 0.9)")
        self.draw("camera")
        self.page.run("document.getElementById('draw-here').click()")
        self.said("Valid: 1 camera.")
        self.assertIn("yaw_deg: -68.75, pitch_deg: 17.19", self.drawn())
        (ROOM / "rig.yaml").write_text(self.drawn())
        done = run("render", "--world", "box_room", "--pose", "0,0,1.6,0", "--cameras", ROOM / "rig.yaml", "--tier", "labels", "--out", ROOM / "seen")
        self.assertEqual(done.returncode, 0, done.stderr)
        ids = read_ids(next((ROOM / "seen").rglob("entity*/*_camera_1.png")))
        self.assertEqual(read_json(next((ROOM / "seen").rglob("entities.json")))[str(ids[360][640])]["name"], "wall south")
        # A rule begins with the thing that was clicked.
        self.draw("label")
        self.page.run("airsim360.main.panorama.turnTo(0, -1.5)")
        box = self.canvas()
        self.page.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        self.page.wait("document.getElementById('draw-match').value === 'floor'")
        self.set_value("draw-category", "ground/floor/painted")
        self.page.run("document.getElementById('draw-here').click()")
        self.said("Valid: 1 rule for 1 thing.")
        (ROOM / "labels.yaml").write_text(self.drawn())
        self.draw("lamp")
        for _ in range(2):
            self.page.run("document.getElementById('draw-here').click()")
        self.said("Valid: 2 lamps.")
        self.page.run("document.getElementById('draw-undo').click()")
        self.said("Valid: 1 lamp.")
        one = self.drawn()
        self.page.run("document.getElementById('draw-redo').click()")
        self.said("Valid: 2 lamps.")
        self.page.run("document.getElementById('draw-undo').click()")
        self.page.run("(() => { document.getElementById('draw-lumens').value = -5; document.getElementById('draw-here').click(); })()")
        self.said("world.yaml:")  # the code that reads the file says what is wrong with it
        self.page.run("document.getElementById('draw-undo').click()")
        self.assertEqual(self.drawn(), one)
        (ROOM / "world.yaml").write_text(one)
        done = run("collect", "--world", ROOM / "world.yaml", "--labels", ROOM / "labels.yaml", "--frames", 1, "--size", "64x32", "--tier", "labels", "--out", ROOM / "drawn_all")
        self.assertEqual(done.returncode, 0, done.stderr)
        entities = {e["name"]: e["category_path"] for e in read_json(ROOM / "drawn_all/entities.json").values()}
        self.assertEqual(entities["floor"], "ground/floor/painted")
        self.assertEqual(json.loads(run("worlds", "--count", ROOM / "world.yaml", "--json").stdout)["entities_by_category"]["furniture/lighting/lamp"], 1)
        self.assertEqual(self.page.problems(), [])

    def test_the_mission_that_one_begins_with_is_flown_by_the_command_too(self):
        self.edit()
        self.page.wait("airsim360.live.trees.xml?.includes('Takeoff')")
        (ROOM / "first.xml").write_text(self.page.run("airsim360.live.trees.xml"))
        done = run("fly", "--world", "box_room", "--mission", ROOM / "first.xml", "--out", ROOM / "first")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_map_shows_more_by_buttons_and_wheel_and_never_less_than_the_flight(self):
        self.open()
        self.page.wait("airsim360.live.picture?.number > 3")
        least = self.page.run("airsim360.map.scale()")
        self.page.run("document.getElementById('map-out').click()")
        self.assertAlmostEqual(self.page.run("airsim360.map.scale()"), least / 2, delta=0.01 * least)
        box = self.page.run("(b => ({x: b.x + b.width / 2, y: b.y + b.height / 2}))((document.getElementById('map').scrollIntoView(), document.getElementById('map').getBoundingClientRect()))")
        self.page.call("Input.dispatchMouseEvent", type="mouseWheel", **box, deltaX=0, deltaY=500)
        self.page.wait(f"airsim360.map.scale() < {0.4 * least}")
        for _ in range(6):
            self.page.run("document.getElementById('map-in').click()")
        self.assertAlmostEqual(self.page.run("airsim360.map.scale()"), least, delta=0.01 * least)

    def test_a_mission_is_flown_from_the_page(self):
        self.edit()
        self.page.wait("document.getElementById('tree-apply').textContent === 'Fly' && document.getElementById('tree-name').value === 'mission'")
        self.write('<root BTCPP_format="4"><BehaviorTree ID="mission"><Sequence><Goto to="-2;2;2"/><Wait seconds="60" name="there"/></Sequence></BehaviorTree></root>')
        self.page.wait("airsim360.live.trees.xml.includes('there')")
        self.press("tree-apply")
        self.page.wait("[...document.querySelectorAll('#tree-graph .active b')].some(e => e.textContent === 'there')", 60)
        p = self.page.run("airsim360.live.picture.p")
        for got, wanted in zip(p, [-2, 2, 2]):
            self.assertAlmostEqual(got, wanted, delta=0.3)
        self.page.run("document.getElementById('tree-stop').click()")
        self.page.wait("document.getElementById('tree-state').textContent.startsWith('none')")


class WorldFileTest(EditorTest):
    @classmethod
    def setUpClass(cls):
        (ROOM / "lit.yaml").write_text("# ours\nworld: box_room\nseed: 3\nlamps:\n  - {x: 1, y: 1, z: 2, lumens: 700}\n")
        cls.arguments = ("--world", ROOM / "lit.yaml")
        super().setUpClass()

    def test_a_lamp_drawn_in_a_world_file_is_added_to_what_it_has(self):
        self.open()
        self.page.wait("airsim360.live.picture?.number > 3")
        self.draw("lamp")
        self.page.run("document.getElementById('draw-here').click()")
        self.said("Valid: 2 lamps.")
        (ROOM / "more.yaml").write_text(self.drawn())
        self.assertEqual(json.loads(run("worlds", "--count", ROOM / "more.yaml", "--json").stdout)["entities_by_category"]["furniture/lighting/lamp"], 2)
        self.assertIn("seed: 3", self.drawn())
        self.assertEqual(self.page.problems(), [])


class PlanTest(PageTest):
    @classmethod
    def setUpClass(cls):
        (ROOM / "tiny.yaml").write_text("name: tiny\npicture: {size: 128x64, tier: fast}\nrows:\n  - {name: room, world: box_room, frames: 4}\n")
        done = run("dataset", "plan", ROOM / "tiny.yaml", "--out", ROOM / "tiny.json")
        assert done.returncode == 0, done.stderr
        cls.arguments = (ROOM / "tiny.json",)
        super().setUpClass()

    def test_a_frame_of_a_plan_is_drawn_when_it_is_looked_at(self):
        self.open("#show=entity&frame=2")
        self.page.wait("airsim360.visited?.length === 1")
        box = self.canvas()
        self.page.run("airsim360.main.panorama.turnTo(0, -1.5)")
        self.page.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        self.page.wait("airsim360.picked")
        self.assertIn("floor", self.text("card"))
        self.page.run("document.getElementById('on').click()")
        self.page.wait("airsim360.visited.length === 2 && airsim360.frame === 3")
        self.assertEqual(self.page.problems(), [])
        self.assert_usable("plan")


class RunTest(PageTest):
    @classmethod
    def setUpClass(cls):
        (ROOM / "templates.json").write_text(json.dumps([{"id": "room/near", "text": "Fly to the box and stop.", "query": {"noun": {"word": "box", "names": ["box"]}, "predicates": [{"is": "nearest"}]},
                                                          "distance": [2.5, 6], "height": [1, 3], "goal_distance": 1}]))
        for command in [("vln", "make", "--world", "box_room", "--templates", ROOM / "templates.json", "--starts", 2, "--out", ROOM / "room.jsonl"),
                        ("vln", "run", ROOM / "room.jsonl", "--agent", "mask", "--view", "front", "--decisions", "yomo", "--out", ROOM / "front.jsonl")]:
            done = run(*command)
            assert done.returncode == 0, done.stderr
        cls.arguments = (ROOM / "front.jsonl", "--episodes", ROOM / "room.jsonl")
        super().setUpClass()

    def test_a_flight_is_replayed_with_its_instruction_its_decisions_and_the_map(self):
        result = json.loads((ROOM / "front.jsonl").read_text().splitlines()[1])
        self.open()
        self.assertEqual(self.text("instruction"), "Fly to the box and stop.")
        self.page.run("document.getElementById('flight-next').click()")
        self.page.wait("airsim360.flights.current.id === " + json.dumps(result["id"]))
        flight = self.page.run("airsim360.flights.current")
        self.assertEqual(self.page.run("airsim360.list.rows"), list(range(flight["first"], flight["last"] + 1)))
        self.assertEqual(self.page.run("document.querySelectorAll('#decisions button').length"), result["decisions"])
        self.assertIn("azimuth", self.text("decisions"))
        # The last decision leads to where it was taken; from there the play goes to the end of this flight and no further.
        self.page.run("[...document.querySelectorAll('#decisions button')].at(-1).click()")
        self.page.wait(f"airsim360.frame === {flight['decisions'][-1]['frame']} && airsim360.shown[0].picture.index === airsim360.frame")
        self.assertEqual(self.page.run("airsim360.shown[0].picture.p"), result["pred"][flight["decisions"][-1]["frame"] - flight["first"]])
        self.assertEqual(self.page.run("document.querySelector('#decisions [aria-current=step]') === [...document.querySelectorAll('#decisions button')].at(-1)"), True)
        self.assertIn("stop", self.text("caption"))
        self.page.key("p")
        self.page.wait(f"airsim360.frame === {flight['last']} && !airsim360.playing")
        self.page.run("airsim360.pick(airsim360.main, 512, 500)")
        self.page.wait("airsim360.picked")
        self.assertIn("floor", self.text("card"))
        self.assertEqual(self.page.problems(), [])
        self.assert_usable("run")


if __name__ == "__main__":
    unittest.main()

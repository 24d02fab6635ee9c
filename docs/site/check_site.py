"""Looks at the built site as its readers meet it: from the disk, in a browser.

Every link and anchor leads somewhere, and no formula has kept its dollars. With Chromium, on a wide and a narrow
screen: no page reports an error or is wider than the screen, formulas have a size, and the search finds a word.
"""
import html.parser
import pathlib
import shutil
import sys
import time
import urllib.parse

WIDTHS = (1200, 390)  # px
VERBATIM = ("code", "pre", "script", "style", "math")


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links, self.anchors, self.dollars, self.verbatim = [], set(), [], 0
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.anchors |= {attributes[name] for name in ("id", "name") if attributes.get(name)}
        self.links += [attributes[name] for name in ("href", "src", "poster", "data") if attributes.get(name)]
        self.verbatim += tag in VERBATIM

    def handle_endtag(self, tag):
        self.verbatim -= tag in VERBATIM

    def handle_data(self, data):
        if "$" in data and not self.verbatim:
            self.dollars.append(data.strip())


def dead_links(site):
    """Of the pages but those of doxygen, whose links it makes by itself."""
    paths = [path for path in site.rglob("*.html") if "reference/cpp/" not in path.as_posix()]
    pages = {path: Page(path) for path in paths if path.name != "404.html"}
    for path, page in pages.items():
        yield from (f"{path.relative_to(site)}: a dollar in the text: {text!r}" for text in page.dollars)
        for link in page.links:
            address = urllib.parse.urlsplit(link)
            if address.scheme or address.netloc:
                continue
            target = (path.parent / urllib.parse.unquote(address.path)).resolve() if address.path else path
            if target.is_dir():
                target /= "index.html"
            anchor = urllib.parse.unquote(address.fragment)
            if not target.is_file() or not target.is_relative_to(site.resolve()):
                yield f"{path.relative_to(site)}: {link} leads nowhere"
            elif anchor and target in pages and anchor not in pages[target].anchors:
                yield f"{path.relative_to(site)}: {link} has no such place"


FLAWS = """
const flaws = [], wide = document.documentElement.scrollWidth;
if (wide > innerWidth) flaws.push(`is ${wide} px wide on a screen of ${innerWidth}`);
for (const formula of document.querySelectorAll("article math"))
  if (formula.getClientRects().length > 0 && formula.getBoundingClientRect().height < 5) flaws.push("has a formula without height");
if (document.querySelector("article .arithmatex")) flaws.push("has a formula that is not typeset");
return flaws;
"""


def open_browser():
    """Chromium without a window; None where it or its driver is not installed."""
    try:
        import selenium.webdriver
    except ImportError:
        return None
    if shutil.which("chromium") is None or shutil.which("chromedriver") is None:
        return None
    options = selenium.webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    service = selenium.webdriver.chrome.service.Service(shutil.which("chromedriver"))
    browser = selenium.webdriver.Chrome(options=options, service=service)
    browser.set_page_load_timeout(120)
    return browser


def seen_in_a_browser(site, browser):
    """What is wrong with the pages at WIDTHS, and with the search."""
    pages = sorted(path for path in site.rglob("*.html") if "reference/cpp/" not in path.as_posix() and path.name != "404.html")
    for width in WIDTHS:
        # The devices that browsers imitate may be narrower than their windows.
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
        for page in pages:
            name = page.relative_to(site)
            browser.get(page.as_uri())
            yield from (f"{name} {flaw}" for flaw in browser.execute_script(FLAWS))
            yield from (f"{name} says {entry['message']}" for entry in browser.get_log("browser"))
    browser.get((site / "index.html").as_uri() + "?q=dirichlet")
    for _ in range(300):
        if browser.find_elements("css selector", ".md-search-result__item"):
            return
        time.sleep(0.2)
    yield "the search finds no page with 'dirichlet' in a minute"


def check(site):
    site = pathlib.Path(site).resolve()
    complaints = list(dead_links(site))
    browser = open_browser()
    if browser:
        try:
            complaints += seen_in_a_browser(site, browser)
        finally:
            browser.quit()
    else:
        print("check_site: without chromium-driver and selenium the pages are not looked at in a browser", flush=True)
    if complaints:
        sys.exit("check_site: " + "\n".join(complaints[:40]))
    print("check_site: every link leads somewhere" + (", and the pages are as they should in a browser" if browser else ""), flush=True)


if __name__ == "__main__":
    check(sys.argv[1])

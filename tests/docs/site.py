# SPDX-License-Identifier: BSD-3-Clause
"""packaging/site makes a site in which a browser finds every page, heading and picture that a link names, and words by its search."""
import functools
import http.server
import json
import queue
import shutil
import subprocess
import sys
import threading
from pathlib import Path

root, site = Path(sys.argv[1]), Path("site").resolve()
missing = [name for name in ("mkdocs", "doxygen", "chromium") if not shutil.which(name)]
if missing:
    print(f"skipped: {', '.join(missing)} is not installed")
    sys.exit()

# Loads the pages in frames, four at a time: pictures that do not load, links that lead nowhere; then a search. The answer is posted.
CHECK = """<!doctype html><script>
const pages = PAGES, files = new Set(FILES), ids = {}, links = [], faults = [];
function frame(url) {
  return new Promise(done => {
    const made = document.createElement("iframe");
    made.onload = () => done(made);
    made.src = url;
    document.documentElement.append(made);
  });
}
async function look(page) {
  const made = await frame("/" + page), inside = made.contentDocument;
  ids[page] = new Set([...inside.querySelectorAll("[id], a[name]")].map(each => each.id || each.name));
  for (const picture of inside.images) {
    await picture.decode().catch(() => faults.push(page + ": no picture " + picture.src));
    if (!picture.naturalWidth) faults.push(page + ": empty picture " + picture.src);
  }
  for (const link of inside.querySelectorAll("a[href], link[href], script[src]")) {
    const url = new URL(link.href || link.src);
    if (url.origin === location.origin) links.push([page, decodeURI(url.pathname.slice(1)), decodeURIComponent(url.hash.slice(1))]);
  }
  made.remove();
}
async function search(word) {
  const made = await frame("/index.html?q=" + word);
  for (let turn = 0; turn < 100; ++turn) {
    const found = [...made.contentDocument.querySelectorAll(".md-search-result__item a")].map(each => each.getAttribute("href"));
    if (found.length) return found;
    await new Promise(done => setTimeout(done, 100));
  }
  return [];
}
async function main() {
  const waiting = [...pages];
  const worker = async () => { while (waiting.length) await look(waiting.shift()); };
  await Promise.all([worker(), worker(), worker(), worker()]);
  for (const [page, target, part] of links) {
    const file = target === "" || target.endsWith("/") ? target + "index.html" : target;
    if (!files.has(file)) faults.push(page + ": no page " + target);
    else if (part && file in ids && !ids[file].has(part)) faults.push(page + ": no heading " + target + "#" + part);
  }
  return {pages: pages.length, links: links.length, faults, found: await search("superquadrics")};
}
main().catch(error => ({faults: [String(error)]})).then(result => fetch("/answer", {method: "POST", body: JSON.stringify(result)}));
</script>"""

subprocess.run([sys.executable, root / "packaging" / "site", site], check=True)
files = [path.relative_to(site).as_posix() for path in site.rglob("*") if path.is_file()]
pages = [name for name in files if name.endswith(".html") and name not in ("search.html", "404.html")]
names = set(pages)
for path in root.glob("docs/**/*.md"):
    name = path.relative_to(root).with_suffix(".html").as_posix().replace("README", "index")
    assert name in names, f"{path}: the site lacks it"
answers = queue.Queue()


class Handler(http.server.SimpleHTTPRequestHandler):
    def do_GET(self):
        if self.path != "/check":
            return super().do_GET()
        self.send_response(200)
        self.end_headers()
        self.wfile.write(CHECK.replace("PAGES", json.dumps(pages)).replace("FILES", json.dumps(files)).encode())

    def do_POST(self):
        answers.put(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
        self.send_response(204)
        self.end_headers()

    def log_message(self, *_):
        pass


with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=site)) as server:
    threading.Thread(target=server.serve_forever, daemon=True).start()
    browser = subprocess.Popen(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", f"--user-data-dir={site}.profile",
                                f"http://127.0.0.1:{server.server_port}/check"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        answer = answers.get(timeout=240)
    finally:
        browser.terminate()
        browser.wait()
        server.shutdown()
assert not answer["faults"], "\n".join(answer["faults"])
assert answer["links"] > 1000 and any("guide/shapes" in name for name in answer["found"]), answer
print(f"{answer['pages']} pages, {answer['links']} links, {len(answer['found'])} pages found")

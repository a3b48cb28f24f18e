# SPDX-License-Identifier: Apache-2.0
"""A server of a folder on this machine, and Chromium's flags for WebGPU without a GPU."""

import http.server
import threading
from pathlib import Path

# SwiftShader draws, which comes with Chromium.
FLAGS = ("--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader")


class Quiet(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm", ".mjs": "text/javascript"}

    def log_message(self, *_):
        pass


class Server:
    """Serves a folder on this machine."""

    def __init__(self, folder: Path):
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), lambda *args: Quiet(*args, directory=str(folder)))
        self.address = f"http://127.0.0.1:{self.server.server_port}/"
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def stop(self):
        self.server.shutdown()
        self.server.server_close()

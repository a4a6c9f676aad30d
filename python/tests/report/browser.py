"""Headless Chromium, driven through the pipe of its DevTools protocol."""

from __future__ import annotations

import json
import os
import select
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

PATIENCE = 30.0  # seconds for any answer


@dataclass
class Seen:
    """What a browser made of a page: its complaints, what it tried to fetch beside the page itself, and what a probe found."""

    complaints: list[str] = field(default_factory=list)
    fetched: list[str] = field(default_factory=list)
    found: Any = None
    after: dict[str, Seen] = field(default_factory=dict)  # what later probes of the same page found, each with all complaints so far


class Browser:
    """One browser for many pages, without a network."""

    def __init__(self, program: str, profile: Path) -> None:
        down, self._write = os.pipe()
        self._read, up = os.pipe()
        # The protocol wants the pipes at 3 and 4.
        self._process = subprocess.Popen(
            [
                "bash", "-c", f'exec "$0" "$@" 3<&{down} 4>&{up}', program, "--headless=new", "--no-sandbox", "--disable-gpu",
                "--remote-debugging-pipe", f"--user-data-dir={profile}", "--no-first-run", "--disable-background-networking",
                "--host-resolver-rules=MAP * ~NOTFOUND", "about:blank",
            ],
            pass_fds=(down, up), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        os.close(down)
        os.close(up)
        self._last = 0
        self._rest = b""

    def close(self) -> None:
        self._process.terminate()
        self._process.wait(PATIENCE)
        os.close(self._read)
        os.close(self._write)

    def look(self, page: Path, probe: str, width: int = 1200, dark: bool = False, after: dict[str, str] | None = None) -> Seen:
        """Opens a page, waits for its plots and runs a probe: a body of JavaScript that returns what it found.

        Probes that change the page come `after`, one by one.
        """
        seen = Seen()
        target = self._ask("Target.createTarget", {"url": "about:blank"})["targetId"]
        session = self._ask("Target.attachToTarget", {"targetId": target, "flatten": True})["sessionId"]

        def ask(method: str, **given: object) -> dict[str, Any]:
            return self._ask(method, given, session, seen)

        for domain in ("Page", "Runtime", "Log", "Network"):
            ask(f"{domain}.enable")
        ask("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        ask("Emulation.setEmulatedMedia", features=[scheme])
        ask("Page.navigate", url=page.as_uri())

        def found(one: str) -> Any:
            body = f"""(async () => {{
                const pause = () => new Promise((done) => setTimeout(done, 20));
                while (document.readyState !== "complete" || document.documentElement.dataset.drawn === undefined) await pause();
                {one}
            }})()"""
            answer = ask("Runtime.evaluate", expression=body, awaitPromise=True, returnByValue=True)
            assert "exceptionDetails" not in answer, answer["exceptionDetails"]
            return answer["result"].get("value")

        def so_far(value: Any) -> Seen:
            return Seen(list(seen.complaints), [url for url in seen.fetched if url != page.as_uri()], value)

        first = so_far(found(probe))
        for name, one in (after or {}).items():
            first.after[name] = so_far(found(one))
        self._ask("Target.closeTarget", {"targetId": target}, None, seen)
        return first if after else so_far(first.found)

    def _ask(
        self, method: str, given: dict[str, Any], session: str | None = None, seen: Seen | None = None
    ) -> dict[str, Any]:
        self._last += 1
        question = {"id": self._last, "method": method, "params": given} | ({"sessionId": session} if session else {})
        os.write(self._write, json.dumps(question).encode() + b"\0")
        end = time.monotonic() + PATIENCE
        while True:
            message = self._next(end)
            if message.get("id") == self._last:
                assert "error" not in message, f"{method}: {message['error']}"
                answer: dict[str, Any] = message["result"]
                return answer
            if seen is not None:
                _note(message, seen)

    def _next(self, end: float) -> dict[str, Any]:
        while b"\0" not in self._rest:
            ready, _, _ = select.select([self._read], [], [], max(end - time.monotonic(), 0))
            assert ready, "the browser does not answer"
            part = os.read(self._read, 1 << 20)
            assert part, "the browser ended"
            self._rest += part
        line, self._rest = self._rest.split(b"\0", 1)
        message: dict[str, Any] = json.loads(line)
        return message


def _note(message: dict[str, Any], seen: Seen) -> None:
    """An event that a clean page does not cause."""
    given = message.get("params", {})
    match message.get("method"):
        case "Runtime.exceptionThrown":
            details = given["exceptionDetails"]
            seen.complaints.append(details.get("exception", {}).get("description") or details["text"])
        case "Runtime.consoleAPICalled" if given["type"] in ("error", "warning", "assert"):
            seen.complaints.append(" ".join(str(part.get("value")) for part in given["args"]))
        case "Log.entryAdded" if given["entry"]["level"] in ("error", "warning"):
            seen.complaints.append(given["entry"]["text"])
        case "Network.requestWillBeSent" if not given["request"]["url"].startswith(("data:", "blob:")):
            seen.fetched.append(given["request"]["url"])

"""How far a run is that takes long."""

import sys
import time


class Progress:
    """The last line of a terminal; lines where there is none."""

    def __init__(self, total):
        self.total = total
        self.begin = time.monotonic()
        self.is_terminal = sys.stderr.isatty()

    def show(self, done, text):
        left = (time.monotonic() - self.begin) / done * (self.total - done) if done else 0
        line = f"[{done}/{self.total}, {left / 60:.0f} min left] {text}"
        print(f"\r\033[K{line[:110]}" if self.is_terminal else line, end="" if self.is_terminal else "\n",
              file=sys.stderr, flush=True)

    def end(self):
        if self.is_terminal:
            print("\r\033[K", end="", file=sys.stderr, flush=True)

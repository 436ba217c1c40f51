"""A page of Markdown, written from top to bottom, and formats of its numbers."""

LINE_WIDTH = 120
FAR_PERCENT = 45  # percentage from Scape's figure that requires an explanation next to the table


def wrap(text, indent=0):
    """Lines of at most LINE_WIDTH characters. None begins with a lone sign that could start a Markdown list."""
    lines = [""]
    for word in text.split(" "):
        if lines[-1].strip() and len(word) > 1 and len(lines[-1]) + 1 + len(word) > LINE_WIDTH:
            lines.append(" " * indent + word)
        else:
            lines[-1] += (" " if lines[-1].strip() else "") + word
    return "\n".join(lines)


class Page:
    def __init__(self):
        self.parts = []

    def heading(self, level, text):
        self.parts.append("#" * level + " " + text)

    def paragraph(self, text):
        self.parts.append(wrap(text))

    def list(self, items):
        self.parts.append("\n".join(wrap("- " + item, 2) for item in items))

    def table(self, header, rows):
        """The first column is text."""
        rows = [[*row, *[""] * (len(header) - len(row))] for row in rows]
        lines = ["| " + " | ".join(map(str, row)) + " |" for row in [header, *rows]]
        lines.insert(1, "|---|" + "---:|" * (len(header) - 1))
        self.parts.append("\n".join(lines))

    def picture(self, path, caption):
        self.parts.append(wrap(f"![{caption}]({path})"))

    def text(self):
        return "\n\n".join(self.parts) + "\n"


def number(value):
    """Four significant digits."""
    return f"{value:.4g}"


def with_sign(value, digits):
    size = f"{abs(value):.{digits}f}"
    return "0" if not size.strip("0.") else ("−" if value < 0 else "+") + size


def change_in_percent(ours, theirs):
    change = 100 * (ours / theirs - 1)
    return with_sign(change, 1 if abs(change) < 9.95 else 0) + " %"


def compare(ours, theirs):
    """"7.06 (7.08, −0.3 %)", or "7.06" without a figure to compare."""
    text, figure = (str(ours), "{:.0f}") if isinstance(ours, int) else (number(ours), "{:g}")
    return text if theirs is None else f"{text} ({figure.format(theirs)}, {change_in_percent(ours, theirs)})"


class Differences:
    """Differences between our figures and Scape's in a section."""

    def __init__(self):
        self.changes = {}

    def add(self, what, ours, theirs):
        if theirs is not None:
            self.changes[what] = 100 * (ours / theirs - 1)

    def sentence(self, noun):
        least, most = min(self.changes.values()), max(self.changes.values())
        farthest = max(self.changes, key=lambda what: abs(self.changes[what]))
        return (f"{len(self.changes)} {noun} differ from Scape's by {with_sign(least, 1)} % to {with_sign(most, 1)} %; "
                f"the farthest is {farthest}.")

    def far(self):
        """Differences that require an explanation: "random on westUS (+86 %), …"; empty if none."""
        return ", ".join(f"{what} ({with_sign(change, 0)} %)" for what, change in self.changes.items()
                         if abs(change) >= FAR_PERCENT)

"""Stand-ins for what asks a user: tests answer, and see what was shown."""

from pathlib import Path

from app.dialogs import Answer


class Answers:
    """Takes the place of `app.dialogs.Dialogs`.

    Set `path`, `typed` and `answer` to what the user would choose; `shown` and `asked` tell what
    was seen.
    """

    def __init__(self):
        self.path: Path | None = None
        self.answer = Answer.CANCEL
        self.shown: list[tuple[str, str]] = []
        self.asked: list[str] = []
        self.suggested: list[Path] = []
        self.typed: str | None = None

    def path_to_open(self, folder):
        self.suggested.append(folder)
        return self.path

    def paths_to_import(self, folder):
        self.suggested.append(folder)
        return [] if self.path is None else [self.path]

    def path_to_save(self, suggestion):
        self.suggested.append(suggestion)
        return self.path

    def path_to_export(self, suggestion, kind):
        self.suggested.append(suggestion)
        return self.path

    def words(self, title, question, suggestion):
        self.asked.append(suggestion)
        return self.typed

    def unsaved(self, title):
        self.asked.append(title)
        return self.answer

    def error(self, title, sentence):
        self.shown.append((title, sentence))

    def about(self):
        self.shown.append(("About", ""))

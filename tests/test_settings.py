import pytest
from PySide6.QtCore import QByteArray, QRect, QSettings

from app.settings import MAX_RECENT, MIN_VISIBLE_PX, Settings, on_screen
from core.profiles import Profile, encode, named

MAIN = QRect(0, 0, 1280, 800)
THIN = Profile(name="thin", title="D\u00fcnn, 1/10", format="svg", entity="cubics", width_mm=0.02)
RIGHT = QRect(1280, 0, 1920, 1080)


@pytest.fixture
def ini(tmp_path):
    return str(tmp_path / "settings.ini")


def stored(ini):
    return Settings(QSettings(ini, QSettings.Format.IniFormat))


def test_values_survive_a_restart(qtbot, ini, tmp_path):
    first = stored(ini)
    first.add_recent(tmp_path / "Füllfläche, 2.ninepoint")
    first.folder = tmp_path
    first.export_choice = "own/thin"
    first.export_profiles = [THIN, named("png")]
    first.export_changes = {"built-in/svg": named("svg").within(0.5), "own/thin": THIN}
    first.window_rect, first.maximised = QRect(10, 20, 640, 480), True
    first.arrangement = QByteArray(b"\x00state\xff")
    first._store.sync()

    second = stored(ini)
    assert second.recent == [tmp_path / "Füllfläche, 2.ninepoint"]
    assert second.folder == tmp_path
    assert second.export_choice == "own/thin"
    assert second.export_profiles == (THIN, named("png"))
    assert second.export_changes == {"built-in/svg": named("svg").within(0.5), "own/thin": THIN}
    assert second.window_rect == QRect(10, 20, 640, 480)
    assert second.maximised
    assert second.arrangement == QByteArray(b"\x00state\xff")


def test_defaults_without_a_store():
    settings = Settings()
    assert settings.recent == []
    assert settings.window_rect is None
    assert not settings.maximised
    assert settings.arrangement.isEmpty()
    assert settings.export_choice == ""
    assert settings.export_profiles == ()
    assert settings.export_changes == {}
    assert settings.folder.is_dir()


def test_nonsense_in_the_store_counts_as_absent(qtbot, ini):
    store = QSettings(ini, QSettings.Format.IniFormat)
    for key in ("window/rect", "window/arrangement", "files/folder", "export/profile"):
        store.setValue(key, 12)
    settings = Settings(store)
    assert settings.window_rect is None
    assert settings.arrangement.isEmpty()
    assert settings.folder.is_dir()
    assert settings.export_choice == ""


@pytest.mark.parametrize(
    "text",
    ["{", "[]", "\x00", "{}", '{"name": "a"}', "\n\n", encode(THIN).decode()[:-1], 12, None],
)
def test_a_damaged_profile_counts_as_absent_and_the_others_stay(qtbot, ini, text):
    store = QSettings(ini, QSettings.Format.IniFormat)
    good = encode(THIN).decode()
    store.setValue("export/own", f"{text}\n{good}\n{text}" if isinstance(text, str) else text)
    store.setValue("export/changes", f"a {text}\nb {good}" if isinstance(text, str) else text)
    settings = Settings(store)
    wanted = isinstance(text, str)
    assert settings.export_profiles == (THIN,) * wanted
    assert settings.export_changes == ({"b": THIN} if wanted else {})


def test_a_profile_of_a_newer_program_counts_as_absent():
    settings = Settings()
    settings._write("export/own", encode(THIN).decode().replace("{", '{"new field":1,'))
    assert settings.export_profiles == ()


def test_recent_files_are_few_and_each_is_listed_once(tmp_path):
    settings = Settings()
    for number in range(MAX_RECENT + 3):
        settings.add_recent(tmp_path / f"{number}.ninepoint")
    settings.add_recent(tmp_path / "5.ninepoint")
    names = [path.stem for path in settings.recent]
    assert names == ["5", "12", "11", "10", "9", "8", "7", "6", "4", "3"]
    settings.remove_recent(tmp_path / "12.ninepoint")
    assert [path.stem for path in settings.recent][:2] == ["5", "11"]
    settings.clear_recent()
    assert settings.recent == []


def test_a_folder_that_is_gone_is_not_proposed(tmp_path):
    settings = Settings()
    settings.folder = tmp_path / "gone"
    assert settings.folder != tmp_path / "gone"


@pytest.mark.parametrize(
    "rect",
    [
        QRect(100, 100, 640, 480),
        QRect(1400, 200, 640, 480),
        QRect(1200, 700, 640, 480),
        QRect(-500, 10, 640, 480),
    ],
)
def test_a_window_that_can_be_reached_stays(rect):
    assert on_screen(rect, [MAIN, RIGHT]) == rect


@pytest.mark.parametrize(
    "rect",
    [
        QRect(5000, 100, 640, 480),
        QRect(100, -400, 640, 480),
        QRect(100, 790, 640, 480),
        QRect(-620, 100, 640, 480),
        QRect(9000, 9000, 4000, 3000),
    ],
)
def test_a_window_out_of_reach_comes_back_whole(rect):
    placed = on_screen(rect, [MAIN])
    assert MAIN.contains(placed)
    assert placed.width() == min(rect.width(), MAIN.width())
    assert placed.height() >= MIN_VISIBLE_PX

"""Every public name has documentation, and every example in it gives what it shows."""

import doctest
import inspect
import re
from pathlib import Path

import tess_model

README = Path(__file__).resolve().parents[1] / "README.md"


def documented() -> "dict[str, str]":
    """The docstrings of the package, its public names and their members."""
    found = {"tess_model": tess_model.__doc__ or ""}
    for name in tess_model.__all__:
        value = getattr(tess_model, name)
        if name == "__version__":
            continue
        found[name] = inspect.getdoc(value) or ""
        if inspect.isclass(value) and value.__module__ == "tess_model":
            for member, of_class in vars(value).items():
                if not member.startswith("_"):
                    text = of_class.__func__.__doc__ if isinstance(of_class, staticmethod) else of_class.__doc__
                    found[f"{name}.{member}"] = text or ""
    return found


def test_every_name_is_documented() -> None:
    lacking = [name for name, text in documented().items() if len(text) < 20]
    assert lacking == []


def test_examples() -> None:
    runner, parser = doctest.DocTestRunner(), doctest.DocTestParser()
    texts = documented()
    texts["README.md"] = "\n".join(re.findall(r"```pycon\n(.*?)```", README.read_text(), re.DOTALL))
    examples = 0
    for name, text in texts.items():
        test = parser.get_doctest(inspect.cleandoc(text), dict(vars(tess_model)), name, name, 0)
        examples += len(test.examples)
        runner.run(test)
    assert runner.summarize().failed == 0 and examples > 20

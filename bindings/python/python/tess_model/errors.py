"""Errors of the package. Every message says what was wrong and what would be right."""


class TessError(ValueError):
    """The base of this package's errors. A plain TessError means that the system refused something, such as
    more threads."""


class ArgumentError(TessError):
    """An argument without a meaning: an unknown name, a wrong number of factors, an array of a wrong type
    or shape, a batch that 32 bits cannot count."""


class NoSuchElementError(TessError, IndexError):
    """A point, primitive or factor that the patch does not have."""


class OutputError(TessError):
    """An array in ``out`` that cannot be written: it is too small, read-only, of a wrong type, not
    C-contiguous, or shares memory with another one. Nothing was written."""


class FileFormatError(TessError):
    """A vector file or a coverage file that is malformed, truncated, too long or empty. The message
    names the file, line and field."""

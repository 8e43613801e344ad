"""Mesa's lavapipe (Vulkan) and llvmpipe (OpenGL) with this library as their tessellator: `cargo xtask mesa` runs this.

    mesa.py [build | compare | test]

Gets Mesa's sources from Debian 13 (trixie), on Debian 12 too; builds the drivers as they are and with the patches beside this
file, all below target/mesa; and compares what they draw. `test` runs this project's tests of Vulkan and OpenGL on the
drivers with all patches.
"""

import json
import os
import platform
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import compare

HERE = Path(__file__).resolve().parent
WORKSPACE = HERE.parent.parent
ROOT = Path(os.environ.get("CARGO_TARGET_DIR", WORKSPACE / "target")).absolute() / "mesa"

VERSION = "25.0.7"

# Debian's release that has this version.
RELEASE = "trixie"

# Mesa with the first patches, by their number.
VARIANTS = {"unpatched": 0, "0001": 1, "0001+0002": 2}

LAVAPIPE = "src/gallium/targets/lavapipe/libvulkan_lvp.so"
DRI = "src/gallium/targets/dri"
EGL = "src/egl/libEGL_mesa.so.0"

# The libraries as the build has them, and as a variant's folder does: they find each other by paths from their own.
LIBRARIES = {
    LAVAPIPE: LAVAPIPE,
    f"{DRI}/libgallium-{VERSION}.so": f"{DRI}/libgallium-{VERSION}.so",
    f"{EGL}.0.0": EGL,
}

# The version of Vulkan that lavapipe has.
VULKAN = "1.4.305"

# The oldest meson that runs the build.
MESON = (1, 1)

# lavapipe, and llvmpipe behind EGL. Wayland's windows need newer protocols than Debian 12 has.
OPTIONS = """
-Dbuildtype=release -Dvulkan-drivers=swrast -Dgallium-drivers=llvmpipe -Dllvm=enabled -Dshared-llvm=enabled -Dopengl=true
-Dshared-glapi=enabled -Dplatforms=x11 -Dglvnd=enabled -Degl=enabled -Dglx=disabled -Dgbm=disabled -Dgles1=disabled
-Dgles2=enabled -Dgallium-vdpau=disabled -Dgallium-va=disabled -Dgallium-xa=disabled -Dvalgrind=disabled
-Dlibunwind=disabled -Dlmsensors=disabled -Dbuild-tests=false -Dmicrosoft-clc=disabled -Dvideo-codecs= -Dzstd=disabled
-Dshader-cache=disabled
"""


def run(*command, **options):
    """Runs a command to its end; anything but success ends this program."""
    command = [str(word) for word in command]
    print("\n$", shlex.join(command), flush=True)
    if (status := subprocess.run(command, **options).returncode) != 0:
        sys.exit(f"`{shlex.join(command)}` ended with {status}")


class Place:
    """The folders of sources, builds and drivers."""

    def __init__(self):
        self.version = VERSION
        self.folder = ROOT / VERSION
        self.source = self.folder / "source"
        self.folder.mkdir(parents=True, exist_ok=True)

    def environment(self, variant):
        """The environment in which Vulkan is a variant's lavapipe, and OpenGL its llvmpipe."""
        driver = self.folder / variant
        found = {"VK_DRIVER_FILES": driver / "lvp_icd.json", "__EGL_VENDOR_LIBRARY_FILENAMES": driver / "50_mesa.json"}
        return {name: str(path) for name, path in found.items()}

    def apt(self, codename, *words, folder):
        """Runs `apt-get` with lists of one release of Debian that are this program's own; the system's lists stay."""
        lists = ROOT / "debian" / codename
        (lists / "lists/partial").mkdir(parents=True, exist_ok=True)
        keys = "/usr/share/keyrings/debian-archive-keyring.gpg"
        of = f"[signed-by={keys}] {mirror()} {codename} main\n"
        (lists / "sources.list").write_text(f"deb {of}deb-src {of}")
        own = ["-q", f"-oDir::Etc::SourceList={lists}/sources.list", "-oDir::Etc::SourceParts=/dev/null"]
        # The caches are of the system's lists.
        own += [f"-oDir::State::Lists={lists}/lists", "-oDir::Cache::pkgcache=", "-oDir::Cache::srcpkgcache="]
        run("apt-get", *own, "update", cwd=lists)
        run("apt-get", *own, *words, cwd=folder)

    def unpack(self, packages, folder):
        """Downloads packages of this machine's release and unpacks them to a folder, without installing them."""
        archives, unpacked = ROOT / "archives", ROOT / "unpacked"
        for scratch in (archives, unpacked):
            shutil.rmtree(scratch, ignore_errors=True)
            scratch.mkdir(parents=True)
        self.apt(codename(), "download", *packages, folder=archives)
        for archive in archives.iterdir():
            run("dpkg", "-x", archive, unpacked)
        unpacked.rename(folder)

    def provide_source(self):
        """Mesa's sources with Debian's patches, as a commit, so that `git` brings a changed file back."""
        if self.source.exists():
            return
        self.apt(RELEASE, "source", "mesa", folder=self.folder)
        unpacked = self.folder / f"mesa-{VERSION}"
        if not unpacked.exists():
            sys.exit(f"Debian's {RELEASE} has another version of Mesa than {VERSION}, for which the patches are")
        # Some formats of sources come with Debian's patches applied.
        if not (unpacked / ".pc/applied-patches").exists():
            for name in (unpacked / "debian/patches/series").read_text().splitlines():
                if name and not name.startswith("#"):
                    run("patch", "-s", "-p1", "-i", unpacked / "debian/patches" / name, cwd=unpacked)
        run("git", "init", "-q", cwd=unpacked)
        run("git", "add", "-A", "-f", cwd=unpacked)
        run("git", "-c", "user.name=-", "-c", "user.email=-", "commit", "-q", "-m", "As Debian has it", cwd=unpacked)
        unpacked.rename(self.source)

    def become(self, variant):
        """Makes the sources those of a variant. Files that stay the same are not touched: little is built again."""
        run("git", "checkout", "-q", ".", cwd=self.source)
        for patch in sorted((HERE / "patches").iterdir())[: VARIANTS[variant]]:
            run("patch", "-s", "-p1", "--no-backup-if-mismatch", "-i", patch, cwd=self.source)
        for file in ("tess_mesa.c", "tess_mesa.h"):
            to = self.source / "src/gallium/auxiliary/tessellator" / file
            if not to.exists() or to.read_bytes() != (HERE / file).read_bytes():
                shutil.copy(HERE / file, to)

    def meson(self):
        """The system's meson, or one of Python's package index where the system's is too old."""
        said = subprocess.run(["/usr/bin/meson", "--version"], capture_output=True, text=True, check=True).stdout
        if tuple(int(number) for number in said.split(".")[:2]) >= MESON:
            return "/usr/bin/meson"
        if not (ROOT / "venv/bin/meson").exists():
            # Mesa's build imports Mako and PyYAML, which the system has.
            run("/usr/bin/python3", "-m", "venv", "--system-site-packages", ROOT / "venv")
            run(ROOT / "venv/bin/python", "-m", "pip", "install", "--quiet", "meson==1.7.0")
        return ROOT / "venv/bin/meson"

    def build(self, variant):
        """Builds a variant in the folder that all share, and keeps its libraries, with manifests for EGL and Vulkan."""
        self.become(variant)
        build, driver = self.folder / "build", self.folder / variant
        # The environment's variable counts only when a folder is set up for the first time.
        options = ["--reconfigure"] if (build / "build.ninja").exists() else []
        options += [f"-Dpkg_config_path={ROOT}/tess/lib/pkgconfig", f"--prefix={self.folder}/install"]
        options += OPTIONS.split()
        options += ["-Dtessellator=tess"] if VARIANTS[variant] else []
        # The system's Python has Mako.
        path = {**os.environ, "PATH": f"/usr/bin:{os.environ['PATH']}"}
        run(self.meson(), "setup", *options, build, self.source, env=path)
        run("ninja", "-C", build, *LIBRARIES, env=path)
        for built, kept in LIBRARIES.items():
            (driver / kept).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(build / built, driver / kept)
        lavapipe = {"library_path": str(driver / LAVAPIPE), "api_version": VULKAN}
        for file, icd in (("50_mesa.json", {"library_path": str(driver / EGL)}), ("lvp_icd.json", lavapipe)):
            (driver / file).write_text(json.dumps({"file_format_version": "1.0.0", "ICD": icd}, indent=2) + "\n")

    def build_all(self):
        run("cargo", "xtask", "install", "--prefix", ROOT / "tess", cwd=WORKSPACE)
        self.provide_source()
        for variant in VARIANTS:
            self.build(variant)
        for variant in VARIANTS:
            print(f"\n{variant}:", *(f"{name}={value}" for name, value in self.environment(variant).items()), sep="\n  ")


def codename():
    """Debian's name of the release that this machine has."""
    return platform.freedesktop_os_release().get("VERSION_CODENAME", "no stable Debian")


def mirror():
    """Where this system gets Debian's packages."""
    known = ["apt-get", "indextargets", "--format", "$(REPO_URI) $(CODENAME)", "Created-By: Packages", "Origin: Debian"]
    # Others are of security updates and the like.
    found = re.search(r"^(\S+) [^-\s]+$", subprocess.run(known, capture_output=True, text=True).stdout, re.MULTILINE)
    return found[1] if found else sys.exit("no list of packages of Debian is known here; on Debian, `apt-get update` gets it")


def main(words):
    work = words.pop(0) if words and words[0] in ("build", "compare", "test") else "all"
    if words:
        sys.exit(f"mesa [build | compare | test], not `{' '.join(words)}`")
    print(f"Mesa {VERSION}, of Debian's {RELEASE}")
    place = Place()
    if work in ("all", "build"):
        place.build_all()
    if work in ("all", "compare"):
        compare.run(place, VARIANTS)
    if work == "test":
        tests = ("cargo", "xtask", "test", "tess-wgpu/tests", "tools/probe/tests")
        # The test of a window needs more than a test that is named sets up.
        run("cargo", "xtask", "setup", cwd=WORKSPACE)
        run(*tests, cwd=WORKSPACE, env={**os.environ, **place.environment("0001+0002")})


if __name__ == "__main__":
    main(sys.argv[1:])

# Uses a part of a release as its users would: sh -eu try.sh PART, in an empty folder outside of the project.
# OUT has the release, ROOT the project, whose examples and recorded results serve here.

# All factors 5, and what an integer triangle patch then has.
patch='tri integer triangle_cw ruler 40a00000 40a00000 40a00000 40a00000'
equal() { test "$1" = "$2" || { echo "observed $1, expected $2" >&2; exit 1; }; }

# No file in these folders, which have what an archive has, names a folder of the machine that built it. What pip writes
# beside a package (direct_url.json) does, so an installed package is no folder for this.
unnamed() {
    # A variable of a function is the caller's too, who has one named folder.
    for builder in "$ROOT/" "$HOME/"; do
        if grep -rlF "$builder" "$@"; then
            echo "these name $builder, a folder of the machine that built them" >&2
            exit 1
        fi
    done
}

# Does what the README at the top of an archive says, here, where all archives of the release are.
follow() {
    ln -sf "$OUT"/* .
    # Without quotes: the pattern stands for a name that is here only now.
    tar -xOf $1 --wildcards --no-wildcards-match-slash '*/README.md' > README.md
    python3 -B "$ROOT/dev/xtask/src/dist/try_readme.py" README.md
}

case $1 in
tess)
    follow tess-[0-9]*.tar.gz
    unnamed tess-*-gnu
    glibc=$(sed -n 's/.*(glibc \(.*\) or later).*/\1/p' README.md)
    newest=$(objdump -T tess-*-gnu/tess | sed -n 's/.*(GLIBC_\([0-9.]*\)).*/\1/p' | sort -uV | tail -n 1)
    equal "$newest" "$glibc" ;;
shaders)
    follow tess-shaders-*.tar.gz
    cd tess-shaders-*/
    unnamed .
    equal "$(wc -c < factors.points) $(wc -c < factors.indices)" "$((27 * 8)) $((37 * 12))"
    for file in spirv/*/*.spv; do spirv-val --target-env vulkan1.1 "$file"; done
    for file in glsl/*/*.comp; do glslangValidator -G "$file"; done ;;
npm)
    follow tess-webgpu-*.tgz
    npm install --no-audit --no-fund typescript@5 @webgpu/types@0.1 @types/three@0.187
    cat > program.mts <<'END'
import { Tessellator, surfacesWgsl, type Output } from "tess-webgpu";
import { Stage, type Feedback } from "tess-webgpu/stage";
import { TessellatedGeometry } from "tess-webgpu/three";
import { Mesh } from "three";
export const text: Promise<string> = surfacesWgsl(["factors"]);
export const run = async (device: GPUDevice): Promise<Output> =>
  (await Tessellator.load(device, { domain: "tri", partitioning: "integer" })).tessellate([1, 2, 3, 4]);
export const room = async (device: GPUDevice): Promise<Feedback> =>
  (await Stage.load(device, { domain: "tri", partitioning: "pow2", patches: 1, vertex: { position: "vec4f" } })).makeRoom();
export const pulled = async (device: GPUDevice, buffer: GPUBuffer): Promise<Feedback> => {
  const setup = { domain: "quad", partitioning: "pow2", patches: 9, vertex: { position: "vec4f" } } as const;
  const stage = await Stage.load(device, { ...setup, meshes: [0, 4], pull: "corners", constants: { fine: 2 } });
  stage.setMeshes([0, 2, 5]);
  return stage.makeRoom({ patches: { buffer, offset: 4 } });
};
export const mesh = async (renderer: object): Promise<Mesh> => {
  const ground = await TessellatedGeometry.load(renderer, { domain: "quad", partitioning: "integer", patches: 1 });
  ground.update({ factors: [1, 2, 3, 4, 5, 6] });
  return new Mesh(ground);
};
END
    node_modules/.bin/tsc --strict --noEmit --module nodenext --target es2022 program.mts
    unnamed node_modules/tess-webgpu
    node "$ROOT/bindings/webgpu/try.mjs" . "$ROOT/golden/cases.txt" ;;
sdl)
    mkdir bin
    ln -s "$TESS_PROGRAM" bin/tess
    PATH=$PWD/bin:$PATH
    follow tess-sdl-*.tar.gz
    cd tess-sdl-*/
    unnamed .
    # 960 by 540 texels of 4 bytes, and the head of the file.
    equal "$(wc -c < terrain.bmp)" "$((960 * 540 * 4 + 138))"
    cd ..
    Xvfb -displayfd 3 -screen 0 800x600x24 -nolisten tcp 3> display 2> /dev/null &
    server=$!
    trap 'kill $server' EXIT
    while ! test -s display; do sleep 0.1; done
    export DISPLAY=:$(cat display) SDL_VIDEO_DRIVER=x11
    ./waves shaders 3
    if ./waves elsewhere 3; then echo 'there are no shaders, and it draws' >&2; exit 1; fi ;;
covergroups)
    ls "$OUT"/tess-c-*.tar.gz || { echo 'its README also takes the archive of the part c: try both' >&2; exit 1; }
    follow tess-uvm-*.tar.gz
    cd tess-uvm-*/
    unnamed .
    cmp bindings/uvm/src/tess_uvm.sv "$ROOT/bindings/uvm/src/tess_uvm.sv"
    grep -c '^ *covergroup ' bindings/uvm/src/tess_covergroups.svh
    # The example's list names files that are here.
    verilator --lint-only -F rtl/tess.f --top-module tess_axis ;;
c)
    follow tess-c-*.tar.gz
    unnamed tess-c-*-gnu
    # An installation may move.
    mv tess-c-*-gnu moved
    cc moved/examples/patch.c $(PKG_CONFIG_PATH=$PWD/moved/lib/pkgconfig pkg-config --cflags --libs tess) -o patch
    equal "$(LD_LIBRARY_PATH=moved/lib ./patch $patch | sed -n 1p)" 'points 27'
    cmake -S moved/examples/cmake -B again -DCMAKE_PREFIX_PATH="$PWD/moved"
    cmake --build again
    again/batch
    again/batch_static ;;
deb)
    # It warns that one package has both what programs load and what they are built with.
    lintian --allow-root --fail-on error "$OUT"/libtess-dev_*.deb
    dpkg -i "$OUT"/libtess-dev_*.deb
    trap 'dpkg -r libtess-dev' EXIT
    zcat -f /usr/share/doc/libtess-dev/README.Debian* > README.md
    python3 -B "$ROOT/dev/xtask/src/dist/try_readme.py" README.md
    build/batch
    build/batch_static ;;
python)
    mkdir wheel sources
    python3 -m zipfile -e "$OUT"/tess_model-*.whl wheel
    tar -xf "$OUT"/tess_model-*.tar.gz -C sources
    unnamed wheel sources
    python3 -m venv venv
    (. venv/bin/activate; follow tess_model-*.tar.gz)
    python3 -m venv --clear venv
    venv/bin/pip install -q "$OUT"/tess_model-*.tar.gz
    equal "$(venv/bin/python draw.py)" '41 points, 60 triangles'
    venv/bin/pip install -q auditwheel 'cyclonedx-python-lib[json-validation]'
    tag=$(basename "$OUT"/tess_model-*-abi3-*.whl .whl | sed 's/.*-abi3-//; s/\..*//')
    venv/bin/auditwheel show "$OUT"/tess_model-*.whl | tee shown
    grep -q "\"$tag\"" shown
    cat > bills.py <<'END'
import pathlib, sys
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
for file in sys.argv[1:]:
    error = JsonStrictValidator(SchemaVersion.V1_5).validate_str(pathlib.Path(file).read_text())
    assert error is None, f"{file}: {error}"
END
    venv/bin/python bills.py "$OUT"/*.cdx.json ;;
crates)
    mkdir src
    cp "$ROOT/Cargo.lock" .
    printf '[package]\nname = "user"\nedition = "2024"\n[workspace]\n[patch.crates-io]\n' > Cargo.toml
    for file in "$OUT"/*.crate; do
        tar -xf "$file"
        folder=$(basename "$file" .crate)
        unnamed "$folder"
        echo "${folder%-*} = { path = '$folder' }" >> Cargo.toml
    done
    echo '[dependencies]' >> Cargo.toml
    for name in core simd gpu surface verify wgpu; do echo "tess-$name = '*'" >> Cargo.toml; done
    # The first example of each README that needs no device.
    for name in core simd surface verify; do
        echo "fn $name() {"
        echo 'println!("{:?}", (|| {'
        sed -n '/^```rust$/,/^```$/{/^```$/q; /^```/d; s/^# //; p}' "tess-$name"-*/README.md
        echo '})()); }'
    done > src/main.rs
    echo 'fn main() { core(); simd(); surface(); verify(); }' >> src/main.rs
    equal "$(cargo run -q | tr '\n' ' ')" '() Ok(()) Ok(()) () ' ;;
esac

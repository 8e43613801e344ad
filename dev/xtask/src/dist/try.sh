# Uses a part of a release as its users would: sh -eu try.sh PART, in an empty folder outside of the project.
# OUT has the release, ROOT the project, whose examples and recorded results serve here.

# All factors 5, and what an integer triangle patch then has.
patch='tri integer triangle_cw ruler 40a00000 40a00000 40a00000 40a00000'
equal() { test "$1" = "$2" || { echo "observed $1, expected $2" >&2; exit 1; }; }

# The library below $1, found by pkg-config and CMake, with the examples in $2.
use_c() {
    cc "$2/patch.c" $(PKG_CONFIG_PATH=$1/lib/pkgconfig pkg-config --cflags --libs tess) -o patch
    equal "$(LD_LIBRARY_PATH=$1/lib ./patch $patch | sed -n 1p)" 'points 27'
    cmake -S "$2/cmake" -B build -DCMAKE_PREFIX_PATH="$1"
    cmake --build build
    build/batch
    build/batch_static
}

case $1 in
shaders)
    tar -xf "$OUT"/tess-shaders-*.tar.gz --strip-components=1
    cc -std=c99 -Ispirv/tri-integer -o host vulkan/*.c -lvulkan
    printf '\0\0\240\100%.0s' 1 2 3 4 > factors
    ./host spirv/tri-integer factors
    equal "$(wc -c < factors.points) $(wc -c < factors.indices)" "$((27 * 8)) $((37 * 12))"
    for file in spirv/*/*.spv; do spirv-val --target-env vulkan1.1 "$file"; done
    for file in glsl/*/*.comp; do glslangValidator -G "$file"; done ;;
npm)
    npm install --no-audit --no-fund "$OUT"/tess-webgpu-*.tgz typescript@5 @webgpu/types@0.1
    cat > program.mts <<'END'
import { Tessellator, type Output } from "tess-webgpu";
export const run = async (device: GPUDevice): Promise<Output> =>
  (await Tessellator.load(device, { domain: "tri", partitioning: "integer" })).tessellate([1, 2, 3, 4]);
END
    node_modules/.bin/tsc --strict --noEmit --module nodenext --target es2022 program.mts
    node "$ROOT/bindings/webgpu/try.mjs" node_modules/tess-webgpu "$ROOT/golden/cases.txt" ;;
covergroups)
    tar -xf "$OUT"/tess-uvm-*.tar.gz --strip-components=1
    cmp uvm/src/tess_uvm.sv "$ROOT/bindings/uvm/src/tess_uvm.sv"
    grep -c '^ *covergroup ' uvm/src/tess_covergroups.svh ;;
c)
    mkdir moved
    tar -xf "$OUT"/tess-c-*.tar.gz --strip-components=1 -C moved
    use_c "$PWD/moved" moved/examples ;;
deb)
    # It warns that one package has both what programs load and what they are built with.
    lintian --allow-root --fail-on error "$OUT"/libtess-dev_*.deb
    dpkg -i "$OUT"/libtess-dev_*.deb
    trap 'dpkg -r libtess-dev' EXIT
    use_c /usr "$ROOT/bindings/c/examples" ;;
python)
    for archive in "$OUT"/tess_model-*.whl "$OUT"/tess_model-*.tar.gz; do
        python3 -m venv --clear venv
        venv/bin/pip install -q "$archive"
        program='import tess_model; p = tess_model.Patch("tri", outer=[5, 5, 5], inner=5); print(len(p.points), len(p.indices))'
        equal "$(venv/bin/python -c "$program")" '27 37'
        equal "$(grep -rlF "$ROOT/" venv/lib/*/site-packages/tess_model* || echo unnamed)" unnamed
    done
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
        echo "${folder%-*} = { path = '$folder' }" >> Cargo.toml
    done
    echo '[dependencies]' >> Cargo.toml
    for name in core simd gpu surface verify wgpu; do echo "tess-$name = '*'" >> Cargo.toml; done
    cat > src/main.rs <<'END'
use tess_core::{Config, DomainPoint, OutputPrimitive, Partitioning, PatchFactors};
use tess_simd::{Numbering, Output, Tessellator};
fn main() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let mut output = Output::<DomainPoint, u32>::new();
    let patch = PatchFactors::Triangle([5.0; 4].into());
    Tessellator::new(config).tessellate(&[patch], Numbering::PerPatch, &mut output).unwrap();
    println!("{} {}", output.points().len(), output.indices().len());
}
END
    equal "$(cargo run -q)" '27 111' ;;
esac

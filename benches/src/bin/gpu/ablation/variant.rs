//! Edited shaders, read from files.

use std::path::Path;

/// Replacements in the shaders' text.
#[derive(Clone)]
pub(crate) struct ShaderVariant {
    /// The file's name.
    pub(crate) name: String,
    edits: Vec<(String, String)>,
}

impl ShaderVariant {
    /// All variants of a folder by name, behind the unedited shaders.
    pub(crate) fn read_all(folder: &Path) -> Result<Vec<Self>, Box<dyn std::error::Error>> {
        let mut all = vec![Self { name: "as they are".to_owned(), edits: Vec::new() }];
        let mut paths: Vec<_> = std::fs::read_dir(folder)?
            .map(|entry| Ok(entry?.path()))
            .collect::<std::io::Result<_>>()?;
        paths.sort();
        for path in paths.iter().filter(|path| path.extension().is_some_and(|ext| ext == "edit")) {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let text = std::fs::read_to_string(path)?;
            let edits = parse(&text).ok_or_else(|| format!("{}: not edits", path.display()))?;
            all.push(Self { name, edits });
        }
        Ok(all)
    }

    /// The first text to find that none of these shaders has.
    pub(crate) fn missing(&self, sources: &[String]) -> Option<&str> {
        let has = |from: &str| sources.iter().any(|source| source.contains(from));
        self.edits.iter().map(|(from, _)| from.as_str()).find(|from| !has(from))
    }

    /// A shader's text after all replacements that apply to it.
    pub(crate) fn edit(&self, source: String) -> String {
        self.edits.iter().fold(source, |source, (from, to)| source.replace(from, to))
    }
}

/// Blocks of a line `<<<`, what to find, a line `===`, what to put there, a line `>>>`.
fn parse(text: &str) -> Option<Vec<(String, String)>> {
    let mut edits = Vec::new();
    for block in text.split("<<<\n").skip(1) {
        let (from, rest) = block.split_once("\n===\n")?;
        let (to, _) = rest.split_once("\n>>>").or_else(|| Some(("", rest.strip_prefix(">>>")?)))?;
        edits.push((from.to_owned(), to.to_owned()));
    }
    Some(edits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
    use tess_gpu::{Setup, Stage};

    /// The edits of this crate still find what they replace.
    #[test]
    fn edits_are_of_the_shaders() {
        let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
        let sources = Stage::ALL.map(|stage| stage.source(Setup::new(Domain::Quad, config)));
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/edits");
        let variants = ShaderVariant::read_all(folder.as_ref()).expect("edits");
        assert!(variants.len() > 5, "{} variants", variants.len());
        for variant in &variants {
            assert_eq!(variant.missing(&sources), None, "{}", variant.name);
        }
    }
}

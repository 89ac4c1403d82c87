//! What the files of a crate name: every path of its code, followed to the module that it leads to.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Attribute, File, Item, ItemExternCrate, ItemFn, ItemMod, ItemUse, Macro, UseTree, Visibility};

/// A module by its names below the root of its crate.
type Module = Vec<String>;

/// What a path leads to.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Name {
    /// A module of the same crate, or something in it.
    Own(Module),
    /// Another crate.
    Other(String),
}

/// A path found in a file.
#[derive(Debug)]
struct Found {
    name: Name,
    /// Whether only tests see it.
    test: bool,
}

/// The files of a crate.
pub struct Crate {
    /// Their texts, by their places.
    texts: BTreeMap<String, String>,
    /// The file of each module.
    modules: BTreeMap<Module, String>,
}

impl Crate {
    /// Reads all files below `folder`, the sources of a crate.
    pub fn read(folder: &Path) -> Self {
        let mut sources = Self { texts: BTreeMap::new(), modules: BTreeMap::new() };
        for path in below(folder) {
            let place = path.display().to_string();
            let inside = path.strip_prefix(folder).expect("a file below the folder").with_extension("");
            let mut module: Module = inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
            if module.last().is_some_and(|last| last == "mod" || module == ["lib"]) {
                module.pop();
            }
            sources.texts.insert(place.clone(), std::fs::read_to_string(&path).expect("a source"));
            sources.modules.insert(module, place);
        }
        sources
    }

    /// Adds code to a file, in memory.
    pub fn plant(&mut self, file: &str, code: &str) {
        let text = self.texts.get_mut(file).expect("a file of the crate");
        text.push('\n');
        text.push_str(code);
    }

    pub fn texts(&self) -> impl Iterator<Item = (&str, &str)> {
        self.texts.iter().map(|(file, text)| (file.as_str(), text.as_str()))
    }

    /// The module at the top that a file belongs to.
    pub fn top(&self, file: &str) -> String {
        let own = self.modules.iter().find(|(_, place)| *place == file);
        own.and_then(|(module, _)| module.first().cloned()).unwrap_or_else(|| "lib".to_string())
    }

    /// All that each file names, by the file.
    pub fn names(&self) -> impl Iterator<Item = (&str, Name)> {
        self.modules
            .iter()
            .flat_map(|(module, file)| self.found(module, file).into_iter().map(|found| (file.as_str(), found.name)))
    }

    /// The files that each file needs outside its tests.
    pub fn graph(&self) -> BTreeMap<String, BTreeSet<String>> {
        let needs = |module: &Module, file: &String| {
            let own =
                self.found(module, file).into_iter().filter(|found| !found.test).filter_map(|found| match found.name {
                    Name::Own(module) => Some(self.file_of(&module)),
                    Name::Other(_) => None,
                });
            own.filter(|other| *other != file).cloned().collect()
        };
        self.modules.iter().map(|(module, file)| (file.clone(), needs(module, file))).collect()
    }

    /// The file of a module, or of the nearest one around it.
    fn file_of(&self, module: &[String]) -> &String {
        let around = (0..=module.len()).rev().find_map(|length| self.modules.get(&module[..length]));
        around.expect("the root of the crate")
    }

    fn found(&self, module: &Module, file: &str) -> Vec<Found> {
        let parsed: File = syn::parse_file(&self.texts[file]).unwrap_or_else(|error| panic!("{file}: {error}"));
        let mut reader =
            Reader { of: self, here: module.clone(), test: false, aliases: BTreeMap::new(), found: Vec::new() };
        // Twice: what is renamed may be used above the place where that is said.
        reader.visit_file(&parsed);
        reader.found.clear();
        reader.visit_file(&parsed);
        reader.found
    }

    fn is_module(&self, module: &[String]) -> bool {
        self.modules.contains_key(module)
    }
}

fn below(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files.extend(below(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// Walks through a file and keeps what it names.
struct Reader<'a> {
    of: &'a Crate,
    /// The module whose code is being read; it may stand within the file.
    here: Module,
    test: bool,
    /// Modules under other names: `use crate::report as other`.
    aliases: BTreeMap<String, Module>,
    found: Vec<Found>,
}

impl Reader<'_> {
    /// What a path leads to; nothing for one that begins with a name of this file's own. `whole` paths may be a single name.
    fn resolve(&self, path: &[String], whole: bool) -> Option<Name> {
        let first = path.first()?.as_str();
        let mut module = self.here.clone();
        let mut rest = path;
        match first {
            "crate" => (module, rest) = (Vec::new(), &path[1..]),
            "self" => rest = &path[1..],
            "super" => {
                while rest.first().is_some_and(|first| first == "super") {
                    module.pop()?;
                    rest = &rest[1..];
                }
            }
            _ if path.len() < 2 && !whole => return None,
            _ if self.of.is_module(&[module.clone(), vec![first.to_string()]].concat()) => {}
            _ if self.aliases.contains_key(first) => (module, rest) = (self.aliases[first].clone(), &path[1..]),
            _ if first.starts_with(|letter: char| letter.is_lowercase()) => {
                return Some(Name::Other(first.to_string()));
            }
            _ => return None,
        }
        for part in rest {
            module.push(part.clone());
            // Beyond a module come the things in it.
            if !self.of.is_module(&module) {
                module.pop();
                break;
            }
        }
        Some(Name::Own(module))
    }

    fn keep(&mut self, path: &[String], whole: bool) {
        if let Some(name) = self.resolve(path, whole) {
            self.found.push(Found { name, test: self.test });
        }
    }

    /// The leaves of a `use` tree.
    fn walk(&mut self, before: &[String], tree: &UseTree) {
        let with = |name: &syn::Ident| {
            let name = name.to_string();
            // `a::{self}` is `a`.
            if name == "self" && !before.is_empty() { before.to_vec() } else { [before, &[name]].concat() }
        };
        match tree {
            UseTree::Path(path) => self.walk(&with(&path.ident), &path.tree),
            UseTree::Group(group) => group.items.iter().for_each(|tree| self.walk(before, tree)),
            UseTree::Name(name) => {
                let path = with(&name.ident);
                self.alias(path.last().cloned().unwrap_or_default(), &path);
                self.keep(&path, true);
            }
            UseTree::Rename(rename) => {
                let path = with(&rename.ident);
                self.alias(rename.rename.to_string(), &path);
                self.keep(&path, true);
            }
            UseTree::Glob(_) => {
                if let Some(Name::Own(module)) = self.resolve(before, true) {
                    let children: Vec<Module> = self
                        .of
                        .modules
                        .keys()
                        .filter(|child| child.len() == module.len() + 1 && child.starts_with(&module))
                        .cloned()
                        .collect();
                    children
                        .into_iter()
                        .for_each(|child| drop(self.aliases.insert(child[module.len()].clone(), child)));
                }
                self.keep(before, true);
            }
        }
    }

    fn alias(&mut self, name: String, path: &[String]) {
        let Some(Name::Own(module)) = self.resolve(path, true) else { return };
        // Only where the path ends at a module.
        let ends = path
            .last()
            .is_some_and(|last| module.last() == Some(last) || ["crate", "self", "super"].contains(&last.as_str()));
        if ends {
            self.aliases.insert(name, module);
        }
    }

    /// Reads what is seen by tests alone where the attributes say so.
    fn under(&mut self, attributes: &[Attribute], read: impl FnOnce(&mut Self)) {
        let of_tests = |attribute: &Attribute| match &attribute.meta {
            syn::Meta::List(list) => attribute.path().is_ident("cfg") && list.tokens.to_string().contains("test"),
            _ => attribute.path().is_ident("test"),
        };
        let before = self.test;
        self.test |= attributes.iter().any(of_tests);
        read(self);
        self.test = before;
    }

    /// Paths among the tokens of a macro, which nobody parses.
    fn tokens(&mut self, tokens: TokenStream) {
        let mut path: Vec<String> = Vec::new();
        let mut colons = 0;
        for token in tokens {
            match token {
                TokenTree::Ident(ident) => {
                    if colons != 2 {
                        let ended = std::mem::take(&mut path);
                        self.keep(&ended, false);
                    }
                    path.push(ident.to_string());
                    colons = 0;
                }
                TokenTree::Punct(mark) if mark.as_char() == ':' => colons += 1,
                other => {
                    let ended = std::mem::take(&mut path);
                    self.keep(&ended, false);
                    colons = 0;
                    if let TokenTree::Group(group) = other {
                        self.tokens(group.stream());
                    }
                }
            }
        }
        self.keep(&path, false);
    }
}

impl<'ast> Visit<'ast> for Reader<'_> {
    fn visit_item_mod(&mut self, item: &'ast ItemMod) {
        self.under(&item.attrs, |reader| {
            reader.here.push(item.ident.to_string());
            visit::visit_item_mod(reader, item);
            reader.here.pop();
        });
    }

    fn visit_item_fn(&mut self, item: &'ast ItemFn) {
        self.under(&item.attrs, |reader| visit::visit_item_fn(reader, item));
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        self.under(&item.attrs, |reader| reader.walk(&[], &item.tree));
    }

    fn visit_item_extern_crate(&mut self, item: &'ast ItemExternCrate) {
        self.found.push(Found { name: Name::Other(item.ident.to_string()), test: self.test });
    }

    fn visit_item(&mut self, item: &'ast Item) {
        visit::visit_item(self, item);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names: Vec<String> = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        self.keep(&names, false);
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, found: &'ast Macro) {
        self.visit_path(&found.path);
        self.tokens(found.tokens.clone());
    }

    /// Who may see something is no use of it.
    fn visit_visibility(&mut self, _: &'ast Visibility) {}
}

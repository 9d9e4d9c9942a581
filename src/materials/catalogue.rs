//! The materials of the catalogue: one TOML file each in `src/materials/`, embedded in the program.

use super::Material;
use crate::parse::data_file::DataFileError;
use std::sync::LazyLock;

/// The texts of the files, by name.
macro_rules! files {
    ($($name:literal)*) => { &[$(($name, include_str!(concat!($name, ".toml")))),*] };
}

/// Every file: its name and its text, in the order of `cutlab list materials`.
pub static MATERIAL_FILES: &[(&str, &str)] = files![
    "diamond"
    "cape-diamond"
    "diamond-rgb"
    "corundum"
    "ruby"
    "sapphire"
    "beryl"
    "emerald"
    "quartz"
    "amethyst"
    "citrine"
    "topaz"
    "tourmaline"
    "zircon"
    "chrysoberyl"
    "spinel"
    "fluorite"
    "calcite"
    "moissanite"
    "cubic-zirconia"
    "yag"
    "strontium-titanate"
    "rutile"
    "n-bk7"
    "fused-silica"
    "pyrope"
    "almandine"
    "rhodolite"
    "spessartine"
    "grossular"
    "demantoid"
    "aquamarine"
    "morganite"
    "heliodor"
    "rubellite"
    "indicolite"
    "paraiba"
    "imperial-topaz"
    "alexandrite"
    "tanzanite"
    "peridot"
    "kunzite"
    "hiddenite"
    "iolite"
    "andalusite"
    "chrome-diopside"
    "sphene"
    "apatite"
    "benitoite"
    "danburite"
    "phenakite"
    "sphalerite"
    "opal"
    "fire-opal"
    "synthetic-spinel"
    "ggg"
    "lithium-niobate"
    "paste"
    "padparadscha"
    "pink-sapphire"
    "yellow-sapphire"
    "goshenite"
    "red-beryl"
    "smoky-quartz"
    "rose-quartz"
    "prasiolite"
    "blue-topaz"
    "green-tourmaline"
    "dravite"
    "chrome-tourmaline"
    "blue-zircon"
    "low-zircon"
    "zoisite"
    "spodumene"
    "kyanite"
    "sillimanite"
    "forsterite"
    "diopside"
    "enstatite"
    "sinhalite"
    "kornerupine"
    "axinite"
    "epidote"
    "euclase"
    "orthoclase"
    "moonstone"
    "labradorite"
    "sunstone"
    "amblygonite"
    "brazilianite"
    "beryllonite"
    "hambergite"
    "cerussite"
    "anglesite"
    "barite"
    "diaspore"
    "grandidierite"
    "scapolite"
    "dioptase"
    "taaffeite"
    "vesuvianite"
    "rhodochrosite"
    "painite"
    "jeremejevite"
    "cassiterite"
    "scheelite"
    "zincite"
    "hessonite"
    "tsavorite"
    "malaia"
    "colour-change-garnet"
    "uvarovite"
    "red-spinel"
    "blue-spinel"
    "periclase"
    "rhodizite"
    "pollucite"
    "moldavite"
];

/// Materials that a design of a bare index is hardly meant for: seldom cut, or drawn for by name.
pub const RARE: &[&str] = &[
    "red-beryl",
    "low-zircon",
    "zoisite",
    "kyanite",
    "sillimanite",
    "forsterite",
    "diopside",
    "enstatite",
    "sinhalite",
    "kornerupine",
    "axinite",
    "epidote",
    "euclase",
    "orthoclase",
    "moonstone",
    "labradorite",
    "sunstone",
    "amblygonite",
    "brazilianite",
    "beryllonite",
    "hambergite",
    "cerussite",
    "anglesite",
    "barite",
    "diaspore",
    "grandidierite",
    "scapolite",
    "dioptase",
    "taaffeite",
    "vesuvianite",
    "rhodochrosite",
    "painite",
    "jeremejevite",
    "cassiterite",
    "scheelite",
    "zincite",
    "malaia",
    "colour-change-garnet",
    "uvarovite",
    "periclase",
    "rhodizite",
    "pollucite",
    "moldavite",
];

/// Every material. A file that cannot be read has none; a test keeps that from happening.
pub static MATERIALS: LazyLock<Vec<Material>> =
    LazyLock::new(|| MATERIAL_FILES.iter().filter_map(|(name, text)| read(name, text).ok()).collect());

/// Diamond, that of a stone of which nothing is known.
pub fn diamond() -> &'static Material {
    static OF_INDEX: LazyLock<Material> = LazyLock::new(|| Material::from_index(2.417));
    MATERIALS.first().unwrap_or(&OF_INDEX)
}

/// The material of one of [`MATERIAL_FILES`].
pub fn read(name: &str, text: &str) -> Result<Material, DataFileError> {
    Material::parse(&format!("{name}.toml"), text, &|_| {
        Err("a material of the catalogue has no other file".into())
    })
}

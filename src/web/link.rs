//! What the part of a link after `#` asks for: `scene=dam_break&columns=71&quality=fine&detail=2`.

use crate::{
    kernel::params::Preset,
    scene::{self, DEFAULT_SCENE, DETAIL, SceneError, blueprint::Blueprint, effects::EffectModes},
    sim::{checkpoint::Checkpoint, file::FileError, world_text},
};
use std::sync::Arc;

/// What a link asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Name of the scene.
    pub scene: String,
    /// The quality, if it is not to be the scene's own.
    pub quality: Option<Preset>,
    /// How many times finer than the scene's own its particles are; 1 if the link does not say.
    pub detail: f64,
    /// Parameters of the scene, and numbers of quality and liquid: what `--set` takes.
    pub settings: Vec<(String, String)>,
    /// Text of a world that the link carries, in place of all else.
    pub world: Option<String>,
}

/// Why a link can't be followed.
#[derive(Debug, thiserror::Error)]
pub enum LinkError {
    /// The scene, or a parameter of it.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The quality.
    #[error("quality `{name}`: no such quality; allowed: {}", Preset::ALL.map(Preset::name).join(", "))]
    Quality {
        /// What the link calls it.
        name: String,
    },
    /// The detail.
    #[error("detail `{text}`; allowed: {DETAIL}")]
    Detail {
        /// What the link says.
        text: String,
    },
    /// The world that it carries.
    #[error(transparent)]
    World(#[from] FileError),
    /// It carries a world, and asks for something besides.
    #[error("a link with a world takes nothing else")]
    WorldAndMore,
    /// The page's script passed something else than a list of pairs.
    #[error("not a list of names and values: {0}")]
    Form(#[from] serde_json::Error),
}

impl Link {
    /// Reads names and values, decoded, as a JSON list of pairs of strings. `scene`, `quality` and `detail` are the
    /// link's own words, all others the scene's.
    ///
    /// # Errors
    /// If it is no such list, or the quality or the detail does not exist.
    pub fn read(pairs: &str) -> Result<Self, LinkError> {
        let mut link =
            Self { scene: DEFAULT_SCENE.to_owned(), quality: None, detail: 1.0, settings: Vec::new(), world: None };
        let pairs = serde_json::from_str::<Vec<(String, String)>>(pairs)?;
        let count = pairs.len();
        for (name, value) in pairs {
            match name.as_str() {
                "world" if count > 1 => return Err(LinkError::WorldAndMore),
                "world" => link.world = Some(value),
                "scene" => link.scene = value,
                "quality" => link.quality = Some(Preset::find(&value).ok_or(LinkError::Quality { name: value })?),
                "detail" => {
                    let number = value.parse().ok().filter(|number| DETAIL.check(*number).is_ok());
                    link.detail = number.ok_or(LinkError::Detail { text: value })?;
                }
                _ => link.settings.push((name, value)),
            }
        }
        Ok(link)
    }

    /// The world that it asks for.
    ///
    /// # Errors
    /// If there is no such scene, it does not take a setting, or the world that the link carries is damaged.
    pub fn open(&self) -> Result<Checkpoint, LinkError> {
        match &self.world {
            Some(text) => Ok(world_text::read(text)?),
            None => Ok(Checkpoint::of_scene(Arc::new(self.build()?))),
        }
    }

    /// Builds the scene.
    ///
    /// # Errors
    /// If there is no such scene, or it does not take a setting.
    pub fn build(&self) -> Result<Blueprint, LinkError> {
        Ok(scene::load(&self.scene)?.at_detail(self.detail).build(&self.settings, self.quality, &EffectModes::new())?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(pairs: &str) -> String {
        Link::read(pairs).and_then(|link| link.build()).expect_err("must be refused").to_string()
    }

    #[test]
    fn a_link_names_scene_quality_and_parameters() {
        let link = Link::read(r#"[["scene","dam_break"],["columns","9"],["quality","fine"],["detail","2"]]"#)
            .expect("is sound");
        let blueprint = link.build().expect("exists");
        assert_eq!((blueprint.name.as_str(), blueprint.preset), ("dam_break", Preset::Fine));
        assert_eq!((blueprint.parameters["columns"], blueprint.particles.len()), (9.0, 4 * 2 * 9 * 9));
    }

    #[test]
    fn an_empty_link_is_the_waterfall() {
        assert_eq!(Link::read("[]").and_then(|link| link.build()).expect("exists").name, "waterfall");
    }

    #[test]
    fn a_bad_link_says_what_is_wrong_in_one_line() {
        for (pairs, about) in [
            (r#"[["scene","nowhere"]]"#, "nowhere"),
            (r#"[["scene","dam_break"],["columns","many"]]"#, "columns"),
            (r#"[["scene","dam_break"],["colums","9"]]"#, "colums"),
            (r#"[["detail","nan"]]"#, "allowed: 0.125 to 8"),
            (r#"[["quality","perfect"]]"#, "allowed: classic, draft"),
            ("scene=empty", "list"),
        ] {
            let error = error(pairs);
            assert!(error.contains(about) && error.lines().count() == 1, "{error}");
        }
        let error = error(r#"[["scene","nowhere"]]"#);
        assert_eq!(error.contains(".ron"), !cfg!(target_arch = "wasm32"), "a page has no files: {error}");
    }
}

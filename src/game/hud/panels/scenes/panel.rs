//! The panel: a search field over the tiles, or the page of one scene.

use super::{
    find::find,
    grid::{self, Pressed},
    menu::{Entry, SceneFolder, SceneMenu},
    pictures::Pictures,
    sheet,
};
use crate::{
    game::{
        actions::PanelId,
        hud::{
            live_picture::Screen,
            motion::ReducedMotion,
            style::weak,
            widgets::keep_focus,
            window::{MIDDLE, PanelWindow, scroll},
        },
        icons,
        input::{
            bindings::{Group, NONE},
            mouse_keys::MouseKeys,
            touch::Fingers,
        },
        orders::{Order, Orders},
        panels::{Panel, Panels, is_open},
    },
    sim::state::Setup,
};
use bevy::{
    asset::Assets,
    image::Image,
    prelude::{
        App, IntoScheduleConfigs, KeyCode, Real, Res, ResMut, Result, Startup, Time, Update, not, resource_exists,
    },
};
use bevy_egui::{
    EguiUserTextures,
    egui::{self, Key, Modifiers, Ui, Vec2, vec2},
};
use tr::tr;

/// Height of all but the tiles, the bars among it, points.
const REST: f32 = 250.0;

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("scenes"),
    title: "Scenes",
    icon: icons::scenes,
    keys: &[(KeyCode::KeyM, NONE)],
    group: Group::World,
    help: "gallery of scenes, and search (can be undone)",
    in_bar: false,
    in_list: None,
    stays: false,
};

/// Adds the panel.
pub fn plugin(app: &mut App) {
    app.init_resource::<SceneMenu>().init_resource::<SceneFolder>().init_resource::<Pictures>();
    Panels::add(app, PANEL, show);
    app.add_systems(Startup, list_scenes).add_systems(
        Update,
        (
            forget.run_if(not(is_open(PANEL.id))),
            make_pictures.run_if(is_open(PANEL.id)).run_if(resource_exists::<EguiUserTextures>),
        ),
    );
}

/// Reads the scenes that come with the game.
fn list_scenes(mut menu: ResMut<SceneMenu>) {
    *menu = SceneMenu::of_game();
}

/// While it is closed nothing runs and nothing is kept.
fn forget(mut menu: ResMut<SceneMenu>, mut pictures: ResMut<Pictures>) {
    if menu.is_open {
        menu.close();
    }
    if !pictures.is_empty() {
        *pictures = Pictures::default();
    }
}

/// What keys ask for.
#[derive(Default)]
struct Pressing {
    enter: bool,
    shift_enter: bool,
    escape: bool,
    way: Option<Vec2>,
}

impl Pressing {
    /// Takes the keys before the search field does.
    fn take(ui: &Ui) -> Self {
        let arrows = [
            (Key::ArrowLeft, vec2(-1.0, 0.0)),
            (Key::ArrowRight, vec2(1.0, 0.0)),
            (Key::ArrowUp, vec2(0.0, -1.0)),
            (Key::ArrowDown, vec2(0.0, 1.0)),
        ];
        ui.input_mut(|input| Self {
            shift_enter: input.consume_key(Modifiers::SHIFT, Key::Enter),
            enter: input.consume_key(Modifiers::NONE, Key::Enter),
            escape: input.consume_key(Modifiers::NONE, Key::Escape),
            way: arrows.into_iter().find(|(key, _)| input.consume_key(Modifiers::NONE, *key)).map(|(_, way)| way),
        })
    }
}

/// Shows the gallery.
fn show(
    mut window: PanelWindow,
    (mut menu, folder): (ResMut<SceneMenu>, Res<SceneFolder>),
    pictures: Res<Pictures>,
    setup: Res<Setup>,
    (fingers, mouse_keys): (Res<Fingers>, Res<MouseKeys>),
    mut orders: ResMut<Orders>,
) -> Result {
    if !menu.is_open {
        menu.open(&folder);
    }
    let menu = &mut *menu;
    let mut done = None;
    window.show(&PANEL, MIDDLE, |ui| {
        let screen = ui.ctx().content_rect();
        ui.set_width(grid::width(screen.width()) + 14.0);
        let keys = Pressing::take(ui);
        let found = search(ui, menu, !fingers.in_use && !mouse_keys.0);
        menu.in_sight.clear();
        if menu.set_up.is_some() {
            done = page(ui, menu, &pictures, &keys);
            return;
        }
        match gallery(ui, menu, (&found, &pictures), (&setup, fingers.in_use), &keys) {
            Some(Pressed::Play(index)) => done = Some(Some(play(&menu.entries[index]))),
            Some(Pressed::SetUp(index)) => menu.set_up(index, &setup),
            None if keys.escape => done = Some(None),
            None => {}
        }
    })?;
    if let Some(order) = done {
        orders.extend(order);
        window.close(PANEL.id);
    }
    Ok(())
}

/// Goes on with the pictures of what is in sight and of what is looked at.
fn make_pictures(
    menu: Res<SceneMenu>,
    mut pictures: ResMut<Pictures>,
    (mut images, mut textures): (ResMut<Assets<Image>>, ResMut<EguiUserTextures>),
    (time, motion): (Res<Time<Real>>, Res<ReducedMotion>),
) {
    let focus = menu.focus.and_then(|index| menu.entries.get(index)).filter(|_| !motion.is_on());
    let wanted: Vec<&Entry> = menu.in_sight.iter().filter_map(|index| menu.entries.get(*index)).collect();
    let mut screen = Screen { images: &mut images, textures: &mut textures };
    pictures.advance(&mut screen, &wanted, focus, time.delta_secs());
}

/// Playing a scene as it comes.
fn play(entry: &Entry) -> Order {
    Order::Scene { name: entry.call.clone(), settings: Vec::new(), detail: 1.0 }
}

/// The page of a scene; whether that is the end, and what is ordered then.
fn page(ui: &mut Ui, menu: &mut SceneMenu, pictures: &Pictures, keys: &Pressing) -> Option<Option<Order>> {
    let wish = sheet::show(ui, menu, pictures);
    if wish.play || keys.enter {
        return Some(sheet::order(menu));
    }
    if wish.back || keys.escape {
        menu.set_up = None;
    }
    None
}

/// The search field, in focus for who `types`; what is found by it. Who does so on the page of a scene goes back to the tiles.
fn search(ui: &mut Ui, menu: &mut SceneMenu, types: bool) -> Vec<usize> {
    let field = egui::TextEdit::singleline(&mut menu.text).hint_text(tr!("search: a name, an element, a word"));
    let field = ui.add(field.desired_width(f32::INFINITY).char_limit(40).margin(vec2(8.0, 5.0)));
    // Fingers would get a keyboard over the tiles that they did not ask for, and the field would have the keys that move the pointer;
    // the number of a slider may be typed, too.
    if types && (menu.set_up.is_none() || !ui.ctx().text_edit_focused()) {
        keep_focus(&field);
    }
    let found = find(&menu.entries, &menu.text);
    if field.changed() {
        menu.set_up = None;
        // While nothing is searched, nothing is found first.
        menu.focus = found.first().copied().filter(|_| !menu.text.trim().is_empty());
    }
    found
}

/// The tiles; what was pressed, and which of them are in sight.
fn gallery(
    ui: &mut Ui,
    menu: &mut SceneMenu,
    (found, pictures): (&[usize], &Pictures),
    (setup, fingers): (&Setup, bool),
    keys: &Pressing,
) -> Option<Pressed> {
    if let Some(way) = keys.way {
        menu.go(way);
    }
    let mut pressed = None;
    scroll(ui, REST, |ui| {
        let playing = &setup.blueprint.name;
        pressed = grid::show(ui, menu, (found, pictures), (playing, fingers));
        for fault in &menu.faults {
            ui.label(weak(fault).small());
        }
    });
    if found.is_empty() {
        ui.label(weak(tr!("Nothing of that name.")));
    }
    ui.add_space(2.0);
    ui.label(
        weak(tr!("Click or Enter plays a scene, arrows look around; the gear or Shift+Enter sets its parameters."))
            .small(),
    );
    let by_key = menu.focus.filter(|index| found.contains(index)).and_then(|index| match keys {
        Pressing { shift_enter: true, .. } => Some(Pressed::SetUp(index)),
        Pressing { enter: true, .. } => Some(Pressed::Play(index)),
        _ => None,
    });
    pressed.or(by_key)
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevy::prelude::{Schedule, World};

    #[test]
    fn its_systems_ask_for_nothing_twice() {
        let (mut world, mut schedule) = (World::new(), Schedule::default());
        schedule.add_systems((show, make_pictures).chain());
        // It panics if they do.
        schedule.initialize(&mut world).expect("they can be put in order");
        assert!(!world.contains_resource::<Pictures>(), "they run only where the plugin is");
    }

    #[test]
    fn what_was_open_is_forgotten_when_it_closes() {
        let mut app = App::new();
        plugin(&mut app);
        // It reads the scenes.
        app.update();
        app.world_mut().resource_mut::<Panels>().toggle(PANEL.id);
        app.world_mut().resource_mut::<SceneMenu>().is_open = true;
        app.world_mut().resource_mut::<SceneMenu>().text = "oil".to_owned();
        app.update();
        assert!(app.world().resource::<SceneMenu>().is_open);
        app.world_mut().resource_mut::<Panels>().toggle(PANEL.id);
        app.update();
        let menu = app.world().resource::<SceneMenu>();
        assert!(!menu.is_open && menu.text.is_empty() && menu.entries.len() > 30);
        assert!(app.world().resource::<Pictures>().is_empty());
    }
}

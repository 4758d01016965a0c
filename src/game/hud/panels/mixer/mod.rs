//! The mixer: an element of one's own, by dials, beside what it does.

mod swatch;

use self::swatch::Swatch;
use crate::{
    game::{
        actions::PanelId,
        hud::{
            style::{self, weak},
            widgets::{LINE, field, main_button, menu, name, row},
            window::{PanelWindow, scroll},
        },
        icons,
        input::bindings::{Group, SHIFT},
        language::spoken,
        mixer::{
            desk::MixerDesk,
            dials::{DIALS, Dial},
            likeness::{LONGEST_NAME, name_of},
            own::{OwnElements, fault},
        },
        orders::{Order, Orders},
        panels::{Panel, Panels, is_open},
        toolbox::Toolbox,
        tools::spaced,
    },
    kernel::element::{Category, Element, ElementId, ElementTable},
    lab::miniature::{HEIGHT, WIDTH},
    sim::state::Setup,
};
use bevy::prelude::{App, IntoScheduleConfigs, KeyCode, Res, ResMut, Result, Update, not, resource_exists};
use bevy_egui::{
    EguiUserTextures,
    egui::{
        self, Align, Align2, Color32, Image, Layout, RichText, ScrollArea, Slider, Ui, Vec2, load::SizedTexture, vec2,
    },
};
use tr::tr;

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("mixer"),
    title: "Mixer",
    icon: icons::flask,
    keys: &[(KeyCode::KeyE, SHIFT)],
    group: Group::Choose,
    help: "mixer: an element of your own, by dials",
    in_bar: false,
    in_list: Some("Mixer: an element of your own"),
    stays: true,
};

/// Width of its contents, points.
const WIDTH_OF_ALL: f32 = 330.0;
/// Width of the track of a dial, points.
const TRACK: f32 = 102.0;
/// Width of what a dial is called, points.
const CALLED: f32 = 102.0;

/// Adds the panel.
pub fn plugin(app: &mut App) {
    app.init_resource::<Swatch>();
    Panels::add(app, PANEL, show);
    app.add_systems(
        Update,
        (
            swatch::forget.run_if(not(is_open(PANEL.id))),
            swatch::run.run_if(is_open(PANEL.id)).run_if(resource_exists::<EguiUserTextures>),
        ),
    );
}

/// Shows the panel.
fn show(
    mut window: PanelWindow,
    (mut desk, own): (ResMut<MixerDesk>, Res<OwnElements>),
    mut swatch: ResMut<Swatch>,
    (setup, tools): (Res<Setup>, Res<Toolbox>),
    mut orders: ResMut<Orders>,
) -> Result {
    let elements = setup.elements();
    desk.begin_with_tool(elements, &tools, &own);
    window.show(&PANEL, (Align2::LEFT_TOP, vec2(14.0, 60.0)), |ui| {
        scroll(ui, 200.0, |ui| {
            ui.set_width(WIDTH_OF_ALL);
            ui.spacing_mut().item_spacing = vec2(6.0, 5.0);
            picture(ui, &swatch);
            if let Some(base) = base(ui, &desk.base, elements) {
                desk.begin(elements, base, &own);
            }
            swatch.waits = match &mut desk.draft {
                Some(draft) => dials(ui, draft),
                None => false,
            };
            orders.extend(end(ui, &desk, elements));
            if own.iter().next().is_some() {
                ui.separator();
                orders.extend(shelf(ui, &own, &mut desk));
            }
        });
    })
}

/// What the draft does.
fn picture(ui: &mut Ui, swatch: &Swatch) {
    let size = vec2(WIDTH_OF_ALL, WIDTH_OF_ALL * HEIGHT as f32 / WIDTH as f32);
    let (rect, _) = ui.allocate_exact_size(size, egui::Sense::hover());
    ui.painter().rect_filled(rect, style::BUTTON_CORNER, Color32::BLACK);
    if let Some(id) = swatch.image() {
        Image::new(SizedTexture::new(id, size)).corner_radius(style::BUTTON_CORNER).paint_at(ui, rect);
    }
}

/// The button that says what the draft is like, and the list under it; the element that is chosen.
fn base(ui: &mut Ui, now: &str, elements: &ElementTable) -> Option<ElementId> {
    let mut chosen = None;
    ui.horizontal(|ui| {
        called(ui, &tr!("like"));
        let button = ui.button(format!("{} …", spoken(&spaced(now))));
        name(&button, &tr!("like which element"), false);
        let button =
            button.on_hover_text(tr!("what becomes of this by heat, in time and by touch becomes of yours, too"));
        menu(&button, &tr!("Begin with one that is like"), |ui| {
            ScrollArea::vertical().max_height(320.0).show(ui, |ui| {
                for category in Category::ALL {
                    for (id, element) in elements.iter().filter(|(_, element)| element.category == category) {
                        if row(ui, &spoken(&spaced(&element.name)), &spoken(category.name()), element.name == now) {
                            chosen = Some(id);
                            ui.close();
                        }
                    }
                }
            });
        });
    });
    chosen
}

/// Its name, its colour and its dials; whether one of them is held.
fn dials(ui: &mut Ui, draft: &mut Element) -> bool {
    let mut is_held = false;
    ui.horizontal(|ui| {
        called(ui, &tr!("name"));
        let mut text = spaced(&draft.name);
        let field = egui::TextEdit::singleline(&mut text).char_limit(LONGEST_NAME).desired_width(150.0);
        if ui.add(field).changed() {
            draft.name = name_of(&text);
        }
        let colour = ui.color_edit_button_srgb(&mut draft.colour);
        name(&colour, &tr!("colour"), false);
        colour.on_hover_text(tr!("its colour"));
    });
    for dial in &DIALS {
        is_held |= (dial.fits)(draft) && turn(ui, dial, draft);
    }
    is_held
}

/// A dial; whether it is held.
fn turn(ui: &mut Ui, dial: &Dial, draft: &mut Element) -> bool {
    ui.horizontal(|ui| {
        called(ui, &spoken(dial.name)).on_hover_text(spoken(dial.help));
        ui.spacing_mut().slider_width = TRACK;
        let mut value = (dial.get)(draft);
        let slider = Slider::new(&mut value, dial.range.clone()).suffix(format!(" {}", dial.unit)).max_decimals(3);
        let slider = match dial.smallest {
            Some(smallest) => slider.logarithmic(true).smallest_positive(smallest),
            None => slider,
        };
        let response = ui.add(slider);
        if response.changed() {
            (dial.set)(draft, value);
        }
        let is_held = response.dragged();
        response.on_hover_text(spoken(dial.help));
        is_held
    })
    .inner
}

/// The name of a line, as wide as all of them.
fn called(ui: &mut Ui, text: &str) -> egui::Response {
    let layout = Layout::left_to_right(Align::Center);
    ui.allocate_ui_with_layout(vec2(CALLED, 18.0), layout, |ui| {
        ui.set_min_width(CALLED);
        ui.label(weak(text))
    })
    .inner
}

/// The button that makes it, or why it can't be made.
fn end(ui: &mut Ui, desk: &MixerDesk, elements: &ElementTable) -> Option<Order> {
    let draft = desk.draft.as_ref()?;
    ui.add_space(2.0);
    if let Some(fault) = fault(draft, &desk.standard) {
        ui.label(RichText::new(fault).small().color(style::WARN));
        return None;
    }
    let (text, told) = match elements.find(&draft.name) {
        Some(_) => (tr!("Change it"), tr!("all of it in this world")),
        None => (tr!("Make it"), tr!("then it is in your hand")),
    };
    ui.horizontal(|ui| {
        let pressed = main_button(ui, &text).clicked();
        ui.label(weak(told).small());
        pressed.then(|| Order::Mix(Box::new(draft.clone())))
    })
    .inner
}

/// The elements that were made before: a click takes one up in this world, the cross forgets it.
fn shelf(ui: &mut Ui, own: &OwnElements, desk: &mut MixerDesk) -> Option<Order> {
    let mut order = None;
    ui.label(weak(tr!("Yours, also for other worlds")));
    for element in own.iter() {
        ui.horizontal(|ui| {
            let [red, green, blue] = element.colour;
            let (dot, _) = ui.allocate_exact_size(Vec2::splat(14.0), egui::Sense::hover());
            ui.painter().circle_filled(dot.center(), 6.0, Color32::from_rgb(red, green, blue));
            let text = spoken(&spaced(&element.name));
            let button = ui.button(&text);
            name(&button, &tr!("take up {}", text), false);
            if button.on_hover_text(tr!("take it up, and begin with it here")).clicked() {
                desk.go_on_with(element.clone());
                order = Some(Order::Mix(Box::new(element.clone())));
            }
            ui.label(weak(spoken(element.category.name())).small());
            let (rect, cross) = field(ui, Vec2::splat(18.0), &tr!("forget {}", text), false, LINE);
            icons::draw(ui.painter(), icons::square(rect.center(), 10.0), icons::close, style::WEAK);
            if cross.on_hover_text(tr!("forget it: worlds that have it keep it")).clicked() {
                order = Some(Order::ForgetElement(element.name.clone()));
            }
        });
    }
    order
}

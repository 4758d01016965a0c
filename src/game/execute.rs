//! Carries out the orders of keys and HUD, between ticks.

use crate::{
    game::{
        actions::Action,
        brush_mode::BrushMode,
        camera::WorldCamera,
        challenges::attempt,
        favourites::{self, Favourites},
        follow,
        frame::SPEED_RANGE,
        gauges::act as gauges,
        history::{self, History},
        hud::panels::details,
        input::{
            bindings::Bindings,
            mouse_keys::MouseKeys,
            pointer::{HudCover, Pointer, ZOOM_STEP},
            rebind,
        },
        language::{grouped, spoken},
        lens::{self, Lens},
        lump::Lump,
        mixer, museum, opening,
        orders::{Order, Orders},
        panels::Panels,
        recording, rewind, saves, screen,
        sound::volume::Volume,
        split, springs,
        stamps::act,
        throws,
        toasts::Toasts,
        toolbox::Toolbox,
        tools::{Tool, spaced},
        views::table::Shown,
    },
    kernel::{params::Preset, piece::Turn},
    lab::{autopilot::Autopilot, dial::Step, gauntlet::CASES, live::accuracy::Survey},
    scene::{
        self,
        effects::{EffectModes, Mode},
    },
    sim::{
        checkpoint::Checkpoint,
        control,
        effects::Effects,
        generation::Generation,
        intent::{Intent, IntentQueue},
        pace::Pace,
        state::{ParticleStore, Rock, Setup},
    },
};
use bevy::prelude::{MouseButton, World};
use std::{mem, sync::Arc};
use tr::tr;

/// Carries out what waits.
pub fn carry_out(world: &mut World) {
    for order in mem::take(&mut **world.resource_mut::<Orders>()) {
        if rewind::ends_with(&order) {
            rewind::finish(world);
        }
        if attempt::refuses(world, &order) {
            continue;
        }
        let before = attempt::opens(&order).then(|| Generation::of(world));
        match order {
            Order::Act(action) => act(world, action),
            Order::Checkpoint => history::checkpoint(world),
            Order::TakePiece(from, to, take) => act::take(world, (from, to), take),
            Order::Paste(at) => act::paste(world, at),
            Order::TakeUpStamp(number) => act::take_up(world, number),
            Order::Quality(preset) => {
                // A choice by hand ends the autopilot.
                world.resource_mut::<Autopilot>().hold(None);
                choose_quality(world, preset);
            }
            Order::Detail(detail) => {
                let preset = world.resource::<Setup>().preset;
                change_detail(world, Step { preset, detail }, &[Intent::Detail { detail }]);
            }
            Order::Accuracy(step) => {
                world.resource_mut::<Autopilot>().hold(None);
                go_to(world, step);
            }
            Order::SecondQuality(preset) => split::choose(world, preset),
            Order::Hold(goal) => world.resource_mut::<Autopilot>().hold(goal),
            Order::Survey(request) => world.resource_mut::<Survey>().request = Some(request),
            Order::Effect(effect, mode) => {
                world.resource_mut::<IntentQueue>().push(Intent::Effect { effect, mode });
            }
            Order::Load(path) => opening::open_file(world, &path),
            Order::LoadBytes { name, bytes } => opening::open_bytes(world, &name, &bytes),
            Order::Scene { name, settings, detail } => {
                let preset = world.get_resource::<Setup>().map(|setup| setup.preset);
                play(world, &name, &settings, preset, detail);
            }
            Order::Open { name, settings, quality, detail } => {
                // Else it would soon go on at another quality.
                world.resource_mut::<Autopilot>().hold(None);
                play(world, &name, &settings, quality, detail);
            }
            Order::Watch(name) => watch(world, name),
            Order::Visit(name) => museum::visit(world, name),
            Order::Throw(name) => throws::throw(world, name),
            Order::SelectGauge(number) => gauges::select(world, number),
            Order::MoveGauge(grip, way) => gauges::drag(world, grip, way),
            Order::RemoveGauge(number) => gauges::remove(world, number),
            Order::SaveReadings => gauges::save(world),
            Order::SetSource(button, stroke) => springs::set(world, button, stroke),
            Order::Challenge(name) => attempt::begin(world, &name),
            Order::ChallengeAgain => drop(attempt::again(world)),
            Order::LeaveChallenge => attempt::leave(world),
            Order::Volume(level) => world.resource_mut::<Volume>().set(level),
            Order::Mix(element) => mixer::act::mix(world, *element),
            Order::ForgetElement(name) => mixer::act::forget(world, &name),
            Order::Keys(order) => rebind::carry_out(world, order),
        }
        if let Some(before) = before {
            attempt::leave_if_replaced(world, before);
        }
        // An undo may have been to another detail, and to fewer elements.
        follow::follow_detail(world);
        follow::follow_elements(world);
    }
}

/// Goes on at another quality; to one of another detail the world is resampled.
fn choose_quality(world: &mut World, preset: Preset) {
    let intent = Intent::Quality { preset, quality: preset.quality() };
    let setup = world.resource::<Setup>();
    if preset.detail() == setup.preset.detail() {
        world.resource_mut::<IntentQueue>().push(intent);
    } else {
        let detail = setup.asked_detail();
        change_detail(world, Step { preset, detail }, &[intent]);
    }
}

/// Goes on at a step of the dial, which is undone as one where the world is resampled.
fn go_to(world: &mut World, step: Step) {
    let Step { preset, detail } = step;
    let setup = world.resource::<Setup>();
    let (now, asked) = (setup.preset, setup.asked_detail());
    if (asked / detail - 1.0).abs() < 1e-6 {
        return choose_quality(world, preset);
    }
    let intents = [Intent::Detail { detail }, Intent::Quality { preset, quality: preset.quality() }];
    // Of the two ways that by the finer world, which loses no rock, if that fits.
    let detail_first = detail * now.detail() >= asked * preset.detail();
    let between = if detail_first { (detail, now) } else { (asked, preset) };
    let fits = control::check_detail(world, between.0, between.1).is_ok();
    if detail_first == fits {
        change_detail(world, step, &intents);
    } else {
        let [first, second] = intents;
        change_detail(world, step, &[second, first]);
    }
}

/// Goes on at another detail, which can be undone; or says why that is not possible. It is done at once: what the
/// pointer does next is in the new d.
fn change_detail(world: &mut World, Step { preset, detail }: Step, intents: &[Intent]) {
    if let Err(error) = control::check_detail(world, detail, preset) {
        world.resource_mut::<Toasts>().warn(error);
        return;
    }
    history::checkpoint(world);
    intents.iter().for_each(|intent| world.resource_mut::<IntentQueue>().push(intent.clone()));
    control::apply_edits(world);
    let count = world.resource::<ParticleStore>().len() + world.resource::<Rock>().count();
    world.resource_mut::<Toasts>().say(tr!("Detail {}: {} particles", detail, grouped(count)));
}

fn act(world: &mut World, action: Action) {
    match action {
        // The pointer follows held buttons and keys, the picture held arrows.
        Action::Hold(_) | Action::Pan(..) | Action::Press(_) => {}
        Action::MouseKeys => turn_mouse_keys(world),
        Action::Sample => sample(world),
        Action::Tool(tool) => take_up(world, tool),
        Action::Element(digit) => use_digit(world, digit),
        Action::Brush(steps) if world.resource::<Lens>().is_on() => world.resource_mut::<Lens>().grow(steps),
        Action::Brush(steps) => world.resource_mut::<Toolbox>().grow(steps),
        Action::BrushShape => world.resource_mut::<Toolbox>().turn_shape(),
        Action::BrushMode(mode) => {
            let now = world.resource::<Toolbox>().mode();
            choose_mode(world, if now == mode { BrushMode::Draw } else { mode });
        }
        Action::NextBrushMode => {
            let next = world.resource::<Toolbox>().mode().next();
            choose_mode(world, next);
        }
        Action::Pause | Action::Step | Action::Speed(_) => keep_time(&mut world.resource_mut(), action),
        Action::Rewind => rewind::ask(world),
        Action::Reset | Action::Undo | Action::Redo | Action::ClearAir => change_world(world, action),
        Action::View(view) => world.resource_mut::<Shown>().0 = view,
        Action::NextView => {
            let mut shown = world.resource_mut::<Shown>();
            shown.0 = shown.0.next();
        }
        Action::Zoom(steps) => {
            let pixel = world.resource::<Pointer>().at;
            let mut camera = world.resource_mut::<WorldCamera>();
            let pixel = pixel.unwrap_or(camera.window() / 2.0);
            camera.zoom_at(pixel, if steps > 0 { ZOOM_STEP } else { 1.0 / ZOOM_STEP });
        }
        Action::Save => {
            recording::write(world);
            saves::save(world);
        }
        Action::Record => recording::toggle(world),
        Action::KeepLastMinute => recording::keep_last_minute(world),
        Action::Panel(id) => world.resource_mut::<Panels>().toggle(id),
        Action::Hud => world.resource_mut::<Panels>().turn_hud(),
        Action::Take(take) => act::take_up_frame(world, take),
        Action::TakeUpStamp => act::take_up_last(world),
        Action::TurnStamp => act::turn(world, Turn::quarter),
        Action::MirrorStamp => act::turn(world, Turn::mirrored),
        Action::FlipStamp => act::turn(world, Turn::flipped),
        Action::Close => {
            if !act::lay_down(world) && !gauges::lay_down(world) {
                world.resource_mut::<Panels>().close_all();
            }
        }
        Action::Split => split::toggle(world),
        Action::Lens => lens::toggle(world),
        Action::Gauge => gauges::set_spot(world),
        Action::GaugeLine => gauges::set_end(world),
        Action::Mute => world.resource_mut::<Volume>().toggle(),
        Action::FullScreen => screen::toggle_full_screen(world),
        Action::Screenshot => screen::take_screenshot(world),
        #[cfg(target_arch = "wasm32")]
        Action::CopyLink => crate::game::link::copy(world),
    }
}

/// Plays another scene at a detail, which can be undone; without a `preset` at its own quality.
fn play(world: &mut World, name: &str, settings: &[(String, String)], preset: Option<Preset>, detail: f64) {
    let scene = scene::load(name).map(|scene| scene.at_detail(detail));
    match scene.and_then(|scene| scene.build(settings, preset, &EffectModes::new())) {
        Ok(blueprint) => {
            // What was built before can be had back.
            if world.contains_resource::<Setup>() {
                history::checkpoint(world);
            }
            Checkpoint::of_scene(Arc::new(blueprint)).restore(world);
        }
        Err(error) => world.resource_mut::<Toasts>().warn(error.to_string()),
    }
}

/// Plays a hard case, at the quality that is in force.
fn watch(world: &mut World, name: &str) {
    let Some(case) = CASES.iter().find(|case| case.name == name) else { return };
    let preset = world.get_resource::<Setup>().map_or(Preset::Balanced, |setup| setup.preset);
    match case.play(world, preset) {
        Ok(()) => world.resource_mut::<History>().clear(),
        Err(error) => world.resource_mut::<Toasts>().warn(error.to_string()),
    }
}

fn take_up(world: &mut World, tool: Tool) {
    world.resource_mut::<Toolbox>().tool = tool;
    let Some(effect) = tool.needs() else { return };
    if world.get_resource::<Effects>().is_some_and(|effects| effects.get(effect).mode == Mode::Off) {
        let (name, key) = (effect.name(), world.resource::<Bindings>().key(Action::Panel(details::PANEL.id)));
        let told = tr!("The {name} is off in this scene: switch it on in the details ({key})", name, key);
        world.resource_mut::<Toasts>().warn(told);
    }
}

/// Chooses what a brush with an element does, and says what that is.
fn choose_mode(world: &mut World, mode: BrushMode) {
    let mut tools = world.resource_mut::<Toolbox>();
    let Tool::Element(element) = tools.tool else {
        let told = tr!("Only an element is drawn over others, erased by itself or made a spring of: choose one");
        world.resource_mut::<Toasts>().say(told);
        return;
    };
    tools.set_mode(mode);
    let Some(setup) = world.get_resource::<Setup>() else { return };
    let name = spoken(&spaced(&setup.elements().get(element).name));
    let told = match mode {
        BrushMode::Draw => tr!("Draw: {} into free room", name),
        BrushMode::Replace => tr!("Replace: what is there becomes {}", name),
        BrushMode::EraseOnly => tr!("Erase only this: {} goes, all else stays", name),
        BrushMode::Spring => {
            tr!("Springs: the left button sets one of {}, the right one a drain; on one: it goes", name)
        }
    };
    world.resource_mut::<Toasts>().say(told);
}

/// Takes up the element on a digit; or puts the one there at whose tile the pointer is, if that is another.
fn use_digit(world: &mut World, digit: char) {
    let Some(setup) = world.get_resource::<Setup>() else { return };
    let element = world.resource::<Favourites>().element(digit, setup.elements());
    let here = element.map(|id| &setup.elements().get(id).name);
    match (world.resource::<HudCover>().element.clone(), element) {
        (Some(pointed), _) if here != Some(&pointed) => favourites::put(world, digit, &pointed),
        (_, Some(element)) => world.resource_mut::<Toolbox>().tool = Tool::Element(element),
        _ => {}
    }
}

fn keep_time(pace: &mut Pace, action: Action) {
    match action {
        Action::Pause => *pace = Pace { paused: !pace.paused, steps_due: 0, ..*pace },
        Action::Speed(steps) => {
            let factor = if steps > 0 { 2.0 } else { 0.5 };
            pace.speed = (pace.speed * factor).clamp(*SPEED_RANGE.start(), *SPEED_RANGE.end());
        }
        _ => *pace = Pace { paused: true, steps_due: pace.steps_due + 1, ..*pace },
    }
}

fn change_world(world: &mut World, action: Action) {
    let told = match action {
        Action::Reset if attempt::again(world) => tr!("From the beginning"),
        Action::Reset => {
            history::checkpoint(world);
            control::reset(world);
            tr!("done" => "Reset")
        }
        Action::ClearAir => {
            history::checkpoint(world);
            world.resource_mut::<IntentQueue>().push(Intent::ClearAir);
            tr!("Air cleared")
        }
        Action::Undo if history::undo(world) => tr!("Undone"),
        Action::Undo => tr!("Nothing to undo"),
        Action::Redo if history::redo(world) => tr!("Made again"),
        _ => tr!("Nothing to make again"),
    };
    world.resource_mut::<Toasts>().say(told);
}

fn turn_mouse_keys(world: &mut World) {
    let on = !world.resource::<MouseKeys>().0;
    world.resource_mut::<MouseKeys>().0 = on;
    let bindings = world.resource::<Bindings>();
    let [left, right, end] = [Action::Press(MouseButton::Left), Action::Press(MouseButton::Right), Action::MouseKeys]
        .map(|of| bindings.key(of));
    let told = match on {
        true => tr!(
            "Mouse keys: the arrows move the pointer, {left} and {right} are its buttons, Tab takes it to the next control; {end} ends it",
            left,
            right,
            end
        ),
        false => tr!("The arrows move the picture again"),
    };
    world.resource_mut::<Toasts>().say(told);
}

/// Takes up the element under the pointer.
fn sample(world: &mut World) {
    let Some(pixel) = world.resource::<Pointer>().at else { return };
    let at = world.resource::<WorldCamera>().to_world(pixel);
    let (Some(particles), Some(rock)) = (world.get_resource::<ParticleStore>(), world.get_resource::<Rock>()) else {
        return;
    };
    if let Some(Lump { element, .. }) = Lump::at(particles, rock, at) {
        world.resource_mut::<Toolbox>().tool = Tool::Element(element);
    }
}

//! Screen readers and other assistive technology. What the HUD tells of its widgets goes to the system's own interface for them
//! (AT-SPI on Linux), and what they ask for happens as if it had been pressed. As long as nothing reads, no tree is made.

use bevy::{
    a11y::{AccessibilityRequested, ActionRequest},
    prelude::{App, IntoScheduleConfigs, Local, MessageReader, PreUpdate, Query, Res, With},
};
use bevy_egui::{EguiContext, EguiInput, EguiPreUpdateSet, PrimaryEguiContext, egui::Event};

/// Tells the HUD to screen readers.
pub fn plugin(app: &mut App) {
    app.add_systems(
        PreUpdate,
        (make_tree_for_readers, hear).after(EguiPreUpdateSet::InitContexts).before(EguiPreUpdateSet::BeginPass),
    );
}

/// Has egui make the tree from when something reads it on.
fn make_tree_for_readers(
    requested: Res<AccessibilityRequested>,
    mut contexts: Query<&mut EguiContext, With<PrimaryEguiContext>>,
    mut made: Local<Option<bool>>,
) {
    let wanted = requested.get();
    if *made == Some(wanted) {
        return;
    }
    for mut context in &mut contexts {
        let context = context.get_mut();
        if wanted {
            context.enable_accesskit();
        } else {
            context.disable_accesskit();
        }
        *made = Some(wanted);
    }
}

/// Hands on what is asked for: to press, to take the focus, to set a value.
fn hear(mut asked: MessageReader<ActionRequest>, mut inputs: Query<&mut EguiInput, With<PrimaryEguiContext>>) {
    for ActionRequest(request) in asked.read() {
        for mut input in &mut inputs {
            input.events.push(Event::AccessKitActionRequest(request.clone()));
        }
    }
}

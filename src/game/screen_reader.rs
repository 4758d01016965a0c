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

#[cfg(test)]
mod tests {
    use super::*;
    use bevy::{
        ecs::{message::Messages, system::RunSystemOnce},
        prelude::World,
    };
    use bevy_egui::egui::{
        Id, RawInput,
        accesskit::{self, TreeId},
    };

    /// A world with the context of a HUD in it.
    fn world() -> World {
        let mut world = World::new();
        world.init_resource::<AccessibilityRequested>();
        world.init_resource::<Messages<ActionRequest>>();
        world.spawn((EguiContext::default(), EguiInput::default(), PrimaryEguiContext));
        world
    }

    /// Whether egui makes a tree.
    fn has_tree(world: &mut World) -> bool {
        let mut context = world.query::<&mut EguiContext>().single_mut(world).expect("there is one");
        let output = context.get_mut().run_ui(RawInput::default(), |ui| _ = ui.button("pour"));
        output.platform_output.accesskit_update.is_some()
    }

    #[test]
    fn the_tree_is_made_as_long_as_somebody_reads() {
        let mut world = world();
        let tell = world.register_system(make_tree_for_readers);
        for reads in [false, true, false] {
            world.resource::<AccessibilityRequested>().set(reads);
            world.run_system(tell).expect("all of it is there");
            assert_eq!(has_tree(&mut world), reads);
        }
    }

    #[test]
    fn what_a_reader_asks_for_comes_to_egui() {
        let mut world = world();
        let request = accesskit::ActionRequest {
            action: accesskit::Action::Click,
            target_tree: TreeId::ROOT,
            target_node: Id::new("pour").accesskit_id(),
            data: None,
        };
        world.write_message(ActionRequest(request.clone()));
        world.run_system_once(hear).expect("all of it is there");
        let input = world.query::<&EguiInput>().single(&world).expect("there is one");
        assert_eq!(input.events, [Event::AccessKitActionRequest(request)]);
    }
}

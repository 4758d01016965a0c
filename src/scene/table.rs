//! An enum that is a table: a variant is a row.

/// An enum whose variants are the rows of a table.
macro_rules! table {
    ($(#[$attribute:meta])* $Name:ident: $Row:ident; $($(#[$doc:meta])* $Variant:ident { $($fields:tt)+ })+) => {
        $(#[$attribute])*
        pub enum $Name { $($(#[$doc])* $Variant,)+ }

        impl $Name {
            /// All of them, in the order of the table.
            pub const ALL: [Self; [$(Self::$Variant),+].len()] = [$(Self::$Variant),+];

            /// Its row of the table.
            pub fn row(self) -> &'static $Row {
                static ROWS: [$Row; $Name::ALL.len()] = [$($Row { $($fields)+ }),+];
                &ROWS[self as usize]
            }

            /// Its name in scenes, on the command line, in the metrics and on the screen.
            pub fn name(self) -> &'static str {
                self.row().name
            }
        }
    };
}

pub(super) use table;

//! Columns of an internal-force study, with one row for each position of the moving particle.

use super::{Cell, TableColumn, decimals, scientific};
use crate::verify::ForceRow;

pub(crate) fn columns<'a>() -> [TableColumn<'a, ForceRow>; 6] {
    [
        TableColumn::<ForceRow>::new(
            "x/h",
            "position",
            "position of the moving particle (cells)",
            |row| Cell::number(row.position, decimals(4)),
        ),
        TableColumn::<ForceRow>::new(
            "n left",
            "n_left",
            "particles in the cell on the left",
            |row| Cell::plain(row.left),
        ),
        TableColumn::<ForceRow>::new(
            "n right",
            "n_right",
            "particles in the cell on the right",
            |row| Cell::plain(row.right),
        ),
        TableColumn::<ForceRow>::new("force", "force", "internal force on the node (N)", |row| {
            Cell::number(row.force, scientific)
        }),
        TableColumn::<ForceRow>::new(
            "predicted",
            "predicted",
            "force predicted by the formula of the suite (N)",
            |row| Cell::number(row.predicted, scientific),
        ),
        TableColumn::<ForceRow>::text("difference", "force minus predicted force (N)", |row| {
            format!("{:.0e}", row.force - row.predicted)
        }),
    ]
}

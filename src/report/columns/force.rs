//! Columns of an internal-force study, with one row for each position of the moving particle.

use super::{TableColumn, decimals, scientific};
use crate::verify::ForceRow;

type ForceColumn<'a> = TableColumn<'a, ForceRow>;

pub(crate) fn columns<'a>() -> [ForceColumn<'a>; 6] {
    let position = "position of the moving particle (cells)";
    let predicted = "force predicted by the formula of the suite (N)";
    [
        ForceColumn::number("x/h", "position", position, decimals(4), |row| row.position),
        ForceColumn::plain("n left", "n_left", "particles in the cell on the left", |row| row.left),
        ForceColumn::plain("n right", "n_right", "particles in the cell on the right", |row| {
            row.right
        }),
        ForceColumn::number(
            "force",
            "force",
            "internal force on the node (N)",
            scientific,
            |row| row.force,
        ),
        ForceColumn::number("predicted", "predicted", predicted, scientific, |row| row.predicted),
        ForceColumn::text("difference", "force minus predicted force (N)", |row| {
            format!("{:.0e}", row.force - row.predicted)
        }),
    ]
}

//! What the page of plans asks for.

use eframe::egui::Context;

use super::App;
use crate::gui::file_dialog::Purpose;
use crate::gui::planner::PlanAction;
use crate::gui::prompt::{Among, Prompt};

impl App {
    pub(super) fn plan(&mut self, ctx: &Context, action: PlanAction) {
        match action {
            PlanAction::Find => self.prompt = Some(Prompt::find(Among::PlanMaterials)),
            PlanAction::FindTradeMetal => self.prompt = Some(Prompt::find(Among::TradeMetals)),
            PlanAction::Add(material) => self.state.planner.add(material),
            PlanAction::Trade(metal) => self.state.planner.trading.metal = metal,
            PlanAction::Choose(file) => self.ask_system(ctx, Purpose::Plan(file)),
            PlanAction::Take(file, path) => self.state.planner.take(ctx, file, path),
        }
    }
}

//! A photograph that is being read, and what can be seen of it before it is.

use std::sync::mpsc;

use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions, Vec2, vec2};

use super::develop::develop;
use super::{Development, Loaded, Source};
use crate::gui::job::{Job, Poll};
use crate::photo::FirstLook;

/// A photograph on its way from a file.
pub(crate) struct Reading {
    job: Job<Source, Result<Loaded, String>>,
    looks: mpsc::Receiver<Look>,
    look: Option<(TextureHandle, Vec2)>,
}

/// A first look, developed for the screen.
struct Look {
    image: ColorImage,
    /// Width and height of the photograph in pixels.
    size: Vec2,
}

impl Reading {
    /// Starts to read.
    pub(crate) fn start(ctx: &Context, source: Source) -> std::io::Result<Self> {
        let (sender, looks) = mpsc::channel();
        let repaint = ctx.clone();
        let mut show = move |look: FirstLook| {
            let image = develop(&look.preview, Development::default());
            // The receiver is gone when reading was given up.
            let _ = sender.send(Look { image, size: vec2(look.width as f32, look.height as f32) });
            repaint.request_repaint();
        };
        let work = move |source: Source, progress: &_| source.load(&mut show, progress);
        Ok(Self { job: Job::start(ctx, "read photograph", source, work)?, looks, look: None })
    }

    /// What is read.
    pub(crate) const fn source(&self) -> &Source {
        &self.job.input
    }

    /// How far it is, 0 to 1.
    pub(crate) fn progress(&self) -> f32 {
        self.job.progress()
    }

    /// What it has come to; takes over a first look on the way.
    pub(crate) fn poll(&mut self, ctx: &Context) -> Poll<Result<Loaded, String>> {
        if let Ok(Look { image, size }) = self.looks.try_recv() {
            self.look = Some((ctx.load_texture("first look", image, TextureOptions::LINEAR), size));
        }
        self.job.poll()
    }

    /// A coarse copy of the photograph, and its size in pixels.
    pub(crate) fn look(&self) -> Option<(&TextureHandle, Vec2)> {
        self.look.as_ref().map(|(texture, size)| (texture, *size))
    }
}

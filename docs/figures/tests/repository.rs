//! Figures made and found out of date, in a repository of the test's own.

#![expect(clippy::unwrap_used, reason = "a test that can't go on fails")]

use figures::{
    make::make,
    manifest::Manifest,
    repository::Repository,
    stale::{Reason, reason},
};
use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

const MANIFEST: &str = r#"(
    groups: {"physics": ["src"]},
    entries: [
        (
            name: "count", page: "docs/page.md", sources: ["@physics", "scene.ron"], quoted: ["README.md"],
            how: Made((commands: ["sh make.sh"], shows: Output, files: ["docs/out.md", "docs/x.svg"],
                pictures: [("Words", "docs/x.svg"), ("None", "docs/y.svg")], takes: "1 s", note: "1 thread")),
        ),
        (
            name: "part", page: "docs/page.md", sources: ["scene.ron"],
            how: Made((commands: ["true"], shows: Table("docs/out.md", "Wanted"), takes: "1 s")),
        ),
        (name: "old", page: "docs/page.md", sources: [], how: ByHand("a record")),
    ],
)"#;

const PAGE: &str = "# Page\n\n<!-- figures: count -->\n*Commit not noted.*\n<!-- end of figures -->\n\n\
                    <!-- figures: part -->\n<!-- end of figures -->\n\n\
                    <!-- figures: old -->\n*Commit 1234567; a machine.*\n<!-- end of figures -->\n";

const SCRIPT: &str = "cat src/a.rs\necho x > docs/x.svg\nprintf '# Out\\n\\n## Wanted\\n\\nWords.\\n\\n| a |\\n|---|\\n| 7 |\\n' > docs/out.md\n";

/// A repository with one commit; removed at the end.
struct Place(PathBuf);

impl Place {
    fn new(test: &str) -> Self {
        let place = Self(std::env::temp_dir().join(format!("figures-{test}-{}", std::process::id())));
        let _ = fs::remove_dir_all(&place.0);
        for (file, text) in [
            ("docs/page.md", PAGE),
            ("src/a.rs", "one\n"),
            ("src/tests/a.rs", "test\n"),
            ("scene.ron", "scene\n"),
            ("make.sh", SCRIPT),
        ] {
            place.write(file, text);
        }
        place.git(&["init", "--quiet"]);
        place.commit();
        place
    }

    fn write(&self, file: &str, text: &str) {
        let path = self.0.join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    fn read(&self, file: &str) -> String {
        fs::read_to_string(self.0.join(file)).unwrap()
    }

    fn git(&self, arguments: &[&str]) {
        let who = ["-c", "user.name=Test", "-c", "user.email=test@example.org", "-c", "commit.gpgsign=false"];
        let status = Command::new("git").arg("-C").arg(&self.0).args(who).args(arguments).status().unwrap();
        assert!(status.success(), "git {arguments:?}");
    }

    fn commit(&self) -> String {
        self.git(&["add", "--all"]);
        self.git(&["commit", "--quiet", "--message", "Change"]);
        self.repository().head().unwrap()
    }

    fn repository(&self) -> Repository<'_> {
        Repository { root: &self.0 }
    }

    fn make(&self, names: &[&str], dirty: bool) -> Result<Vec<String>, String> {
        let manifest = Manifest::parse(MANIFEST).unwrap();
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        let entries = manifest.named(&names).unwrap();
        make(&self.repository(), &manifest, &entries, dirty, &mut |_| {}).map_err(|fault| fault.to_string())
    }

    fn reason(&self, name: &str) -> Result<Option<Reason>, String> {
        let manifest = Manifest::parse(MANIFEST).unwrap();
        let entry = manifest.named(&[name.to_owned()]).unwrap()[0];
        reason(&self.repository(), &manifest, entry).map_err(|fault| fault.to_string())
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn figures_are_made_with_their_commit_and_are_stale_when_their_sources_change() {
    let place = Place::new("stale");
    let first = place.repository().head().unwrap();
    assert_eq!(place.reason("count"), Ok(Some(Reason::NoCommit)));
    assert!(place.reason("part").unwrap_err().starts_with("docs/page.md: the figures part don't say where"));
    // Pages and files that were just made don't stand in the way of the next.
    assert_eq!(place.make(&["count"], false), Ok(vec![]));
    assert_eq!(place.make(&[], false), Ok(vec![]));
    let page = place.read("docs/page.md");
    assert!(
        page.contains(&format!("<!-- figures: count -->\n\n![Words](x.svg)\n\none\n\n*Commit {first}; ")),
        "{page}"
    );
    assert!(page.contains("; 1 thread"), "{page}");
    assert!(page.contains("<!-- figures: part -->\n\n| a |\n|---|\n| 7 |\n\n*Commit "), "without the words: {page}");
    assert!(page.ends_with("*Commit 1234567; a machine.*\n<!-- end of figures -->\n"), "what is made by hand stays");
    assert!(
        place.read("docs/out.md").contains(&format!("| 7 |\n\n*Commit {first}; ")),
        "what is written is signed, too"
    );
    place.commit();
    assert_eq!(place.reason("count"), Ok(None), "its own commit is none of its sources");
    place.write("src/tests/a.rs", "another test\n");
    place.commit();
    assert_eq!(place.reason("count"), Ok(None), "tests change no figure");
    place.write("src/a.rs", "two\n");
    place.commit();
    assert_eq!(place.reason("count"), Ok(Some(Reason::Changed(first.clone(), vec!["src/a.rs".to_owned()]))));
    assert_eq!(place.reason("part"), Ok(None), "not one of its sources");
    assert_eq!(place.reason("old"), Ok(None), "a record of what is gone is never stale");
    assert_eq!(place.make(&["count"], false), Ok(vec![]));
    assert_eq!(place.reason("count"), Ok(None));
    assert!(place.read("docs/page.md").contains("\n\ntwo\n\n") && !place.read("docs/page.md").contains("\none\n"));
}

#[test]
fn what_no_commit_has_is_refused_or_noted() {
    let place = Place::new("dirty");
    place.write("src/new.rs", "new\n");
    let refused = place.make(&["count"], false).unwrap_err();
    assert!(refused.starts_with("src/new.rs is not as commit ") && refused.contains("--dirty"), "{refused}");
    assert_eq!(place.read("docs/page.md"), PAGE);
    assert_eq!(place.make(&["count"], true), Ok(vec![]));
    assert!(place.read("docs/page.md").contains(" with changes; "));
    assert!(matches!(place.reason("count"), Ok(Some(Reason::WithChanges(_)))));
}

#[test]
fn a_command_that_fails_leaves_the_page_as_it_was() {
    let place = Place::new("fails");
    place.write("make.sh", "echo half\nexit 3\n");
    place.commit();
    let fault = place.make(&["count"], false).unwrap_err();
    assert!(fault.starts_with("count: sh make.sh: exit status: 3"), "{fault}");
    assert_eq!(place.read("docs/page.md"), PAGE);
    // A check that fails is a result: it is shown, and said.
    place.write("make.sh", "echo FAIL; echo '# Out' > docs/out.md\nexit 1\n");
    place.commit();
    assert_eq!(place.make(&["count"], false), Ok(vec!["count: sh make.sh: a check failed".to_owned()]));
    assert!(place.read("docs/page.md").contains("\n\nFAIL\n\n"));
    // Without the section, the table is missing.
    let fault = place.make(&["part"], false).unwrap_err();
    assert!(fault.starts_with("part: ") && fault.ends_with("docs/out.md has no section Wanted"), "{fault}");
    place.write("make.sh", "echo changed >> src/a.rs; echo '# Out' > docs/out.md; echo 1\n");
    place.commit();
    assert!(place.make(&["count"], false).unwrap_err().contains("changed while it was made"));
}

#[test]
fn unknown_commits_are_a_reason_and_missing_marks_and_no_repository_one_line() {
    let place = Place::new("unknown");
    place.write("docs/page.md", &PAGE.replace("*Commit not noted.*", "*Commit 0123456; a machine.*"));
    assert_eq!(place.reason("count"), Ok(Some(Reason::NotHere("0123456".to_owned()))));
    place.write("docs/page.md", "# Page\n");
    assert!(place.make(&["count"], false).unwrap_err().starts_with("docs/page.md: no place for the figures count"));
    fs::remove_dir_all(place.0.join(".git")).unwrap();
    // Above the place there may be a repository, but not in the system's folder for what is temporary.
    let fault = place.repository().head().unwrap_err().to_string();
    assert!(fault.contains("git rev-parse: ") && fault.lines().count() == 1, "{fault}");
    assert!(Path::new(&place.0).exists());
}
